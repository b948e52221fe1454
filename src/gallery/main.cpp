// `./run gallery`: renders every picture of output/ and writes the page that shows them.
//
// Pictures go through the program's own command line, so that the commands on the page are the ones that were run.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/metadata.hpp"
#include "cli/overrides.hpp"
#include "cli/statistics.hpp"
#include "gallery/entries.hpp"
#include "image/atomic_file.hpp"
#include "scene/counted.hpp"

namespace fs = std::filesystem;
using namespace orrery;

namespace {

/// "A scene OPTION..." as the words of a command line, the scene found in `scenes`.
Arguments parse(std::string_view words, const fs::path& scenes) {
    std::istringstream split{std::string(words)};
    std::vector<std::string> all{"orrery", "render"};
    for (std::string word; split >> word;) all.push_back(all.size() == 2 ? (scenes / word).string() : word);
    std::vector<const char*> argv;
    for (const std::string& word : all) argv.push_back(word.c_str());
    const auto read = read_arguments(static_cast<int>(argv.size()), argv.data());
    if (const auto* answer = std::get_if<Answer>(&read)) throw std::runtime_error(answer->error);
    return std::get<Arguments>(read);
}

RenderStats render_entry(const GalleryEntry& entry, const fs::path& scenes, const fs::path& output) {
    std::optional<Scene> scene = load_scene(parse(entry.arguments, scenes));
    if (!scene) throw std::runtime_error(fmt::format("{} does not load", entry.arguments));
    const Plan plan(std::move(*scene));
    const RenderResult result = render(plan, {});
    const fs::path file = output / entry.file;
    write_image(file, result.image, tone_mapper(plan.settings()), image_metadata(plan, ImageFormat::png));
    fmt::print("{}: {:.1f} s, {:.1f} Mrays/s\n", file.string(), result.stats.seconds,
               rays_per_second(result.stats) / 1e6);
    return result.stats;
}

std::string page_of(const std::map<std::string_view, RenderStats>& stats) {
    const RenderStats& any = stats.begin()->second;
    std::string page = fmt::format(
        "# Gallery\n\nMade by `./run gallery`, which renders the pictures and writes this page ({}, {}; "
        "seconds "
        "are of rendering, rays are closest-hit and shadow rays together).\n",
        isa_name(any.isa), counted(any.threads, "thread"));
    std::string_view section;
    for (const GalleryEntry& entry : gallery()) {
        if (entry.section != section) {
            section = entry.section;
            page += fmt::format(
                "\n## {}\n\n| picture | `./run render scenes/`... | samples | seconds | Mrays/s |\n"
                "|---|---|---|---|---|\n",
                section);
        }
        const RenderStats& s = stats.at(entry.file);
        page += fmt::format("| ![{0}]({1})<br>{0} | `{2}` | {3} | {4:.2f} | {5:.0f} |\n", entry.caption, entry.file,
                            entry.arguments, s.samples_per_pixel, s.seconds, rays_per_second(s) / 1e6);
    }
    return page;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        fmt::print(stderr, "usage: orrery_gallery SCENES OUTPUT\n");
        return 2;
    }
    try {
        const fs::path output = argv[2];
        std::map<std::string_view, RenderStats> stats;
        for (const GalleryEntry& entry : gallery()) stats[entry.file] = render_entry(entry, argv[1], output);
        const std::string page = page_of(stats);
        write_atomically(output / "README.md", std::as_bytes(std::span(page)));
    } catch (const std::exception& fault) {
        fmt::print(stderr, "orrery_gallery: {}\n", fault.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
