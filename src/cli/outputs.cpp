#include "cli/outputs.hpp"

#include <fmt/format.h>

#include <set>

#include "cli/exit_code.hpp"
#include "image/atomic_file.hpp"
#include "image/image_file.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;

/// One name for all spellings of a file, links included.
fs::path identity(const fs::path& file) {
    std::error_code error;
    fs::path canonical = fs::weakly_canonical(fs::absolute(file, error), error);
    return error ? file : canonical;
}

void require_known_ending(const fs::path& file, const std::string& option) {
    try {
        static_cast<void>(image_format(file));
    } catch (const std::invalid_argument& fault) {
        throw UsageError(fmt::format("{}: {}", option, fault.what()));
    }
}

}  // namespace

Outputs choose_outputs(const Arguments& arguments, const Scene& scene) {
    Outputs outputs;
    outputs.images = arguments.outputs;
    for (const fs::path& image : outputs.images) require_known_ending(image, "--output");
    if (outputs.images.empty()) {
        const fs::path& own = scene.settings.output;
        if (own.empty())
            throw UsageError(fmt::format("{} names no output, expected --output FILE", scene.file.string()));
        require_known_ending(own, scene.file.string() + ":/scene/renderer/output");
        outputs.images.push_back(own);
    }
    if (arguments.stats == "-") {
        outputs.stats_to_standard_output = true;
    } else if (arguments.stats) {
        outputs.stats = *arguments.stats;
    }

    std::set<fs::path> taken = {identity(scene.file)};
    const auto take = [&](const fs::path& file) {
        if (!taken.insert(identity(file)).second)
            throw UsageError(fmt::format("{}: this file is named twice, expected different files", file.string()));
    };
    for (const fs::path& image : outputs.images) take(image);
    if (outputs.stats) take(*outputs.stats);
    return outputs;
}

void require_writable(const Outputs& outputs, const Scene& scene) {
    for (const fs::path& image : outputs.images) {
        // A failure is left to writable_target, which says more about it.
        std::error_code error;
        if (image == scene.settings.output && image.has_parent_path()) fs::create_directory(image.parent_path(), error);
        static_cast<void>(writable_target(image));
    }
    if (outputs.stats) static_cast<void>(writable_target(*outputs.stats));
}

}  // namespace orrery
