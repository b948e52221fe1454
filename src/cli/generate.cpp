#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/options.hpp"
#include "cli/process.hpp"
#include "cli/request.hpp"
#include "image/atomic_file.hpp"
#include "worlds/write_world.hpp"

namespace orrery {
namespace {

/// What `orrery generate` is to write, and where.
struct Generation {
    worlds::Kind kind = worlds::Kind::random;
    std::uint32_t spheres = 0;
    std::uint32_t seed = 0;
    std::optional<std::filesystem::path> output;  ///< empty: standard output
    bool quiet = false;
};

/// As many as a scene file below the reader's limit has room for.
constexpr std::uint32_t most_spheres = 10'000'000;

constexpr const char* example =
    "Kinds: random (evenly in a ball), lattice (a cube of rows), cluster (dense knots, emptiness between), cosmos "
    "(spiral galaxies; radii follow a power law). Each frames itself, whatever the number.\n"
    "\n"
    "Example: a million spheres, and a look at them\n"
    "  {0} generate cosmos --spheres 1000000 -o cosmos.json\n"
    "  {0} render cosmos.json -o cosmos.png\n"
    "\n"
    "A file holds about 150 bytes a sphere, one shape and one primitive a line; it is written whole or not at all. "
    "Exit code: 0 written, 1 the work failed, 2 bad usage.";

int generate(const Generation& g) {
    const worlds::World world = worlds::make_world(g.kind, g.spheres, g.seed);
    const std::string_view name = worlds::kind_names[static_cast<std::size_t>(g.kind)];
    if (!g.output) {
        worlds::write_world(world, g.spheres, name, print_result);
        return exit_code::done;
    }
    AtomicFile file(*g.output);
    worlds::write_world(world, g.spheres, name,
                        [&](std::string_view text) { file.write(std::as_bytes(std::span(text))); });
    file.commit();
    print_name(*g.output);
    return exit_code::done;
}

}  // namespace

Work add_generate(CLI::App& app) {
    const auto request = std::make_shared<Generation>();
    add_option(app, "KIND", fmt::format("{}", fmt::join(worlds::kind_names, "|")), "What world to make",
               [request](const std::string& text) {
                   request->kind = static_cast<worlds::Kind>(parse_word(text, worlds::kind_names));
               })
        ->required()
        ->group("Scene");
    add_option(app, "--spheres", "N", "How many spheres, at most ten million",
               [request](const std::string& text) { request->spheres = parse_integer(text, 1, most_spheres); })
        ->required()
        ->group("Scene");
    add_option(app, "--seed", "N",
               "Another seed is another world of its kind; the same one, the same file (default: 0)",
               [request](const std::string& text) {
                   request->seed = parse_integer(text, 0, std::numeric_limits<std::uint32_t>::max());
               })
        ->group("Scene");
    add_option(app, "-o,--output", "FILE", "Scene file to write (default: -, standard output)",
               [request](const std::string& text) {
                   if (text != "-") request->output = text;
               })
        ->group("Scene");
    add_quiet(app, request->quiet);
    app.footer(fmt::format(example, typed_command()));
    return [request] { return generate(*request); };
}

}  // namespace orrery
