#include "cli/outputs.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <set>

#include "cli/process.hpp"
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

/// Standard errors are no colours: tone mapped to 8 bit they would mean nothing.
void require_linear(const fs::path& file) {
    const ImageFormat format = image_format(file);
    if (format == ImageFormat::pfm || format == ImageFormat::exr) return;
    throw UsageError(fmt::format("--error-image: found {}, expected a file ending in .pfm or .exr", file.string()));
}

/// Whether standard output or error goes to this very file: it would be another one after a rename, and what is
/// printed later would be lost.
bool is_standard_stream(const fs::path& file) {
    struct stat named = {}, open = {};
    if (::stat(file.c_str(), &named) != 0) return false;
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        if (::fstat(stream, &open) == 0 && open.st_dev == named.st_dev && open.st_ino == named.st_ino) return true;
    return false;
}

}  // namespace

void require_known_ending(const fs::path& file, const std::string& option) {
    try {
        static_cast<void>(image_format(file));
    } catch (const std::invalid_argument& fault) {
        throw UsageError(fmt::format("{}: {}", option, fault.what()));
    }
}

void require_different_files(const std::vector<fs::path>& read, const std::vector<fs::path>& written) {
    std::set<fs::path> taken;
    for (const fs::path& file : read) taken.insert(identity(file));
    for (const fs::path& file : written) {
        if (!taken.insert(identity(file)).second)
            throw UsageError(fmt::format("{}: this file is named twice, expected different files", file.string()));
        if (is_standard_stream(file))
            throw UsageError(
                fmt::format("{}: standard output or error goes to this file, expected another one", file.string()));
    }
}

Outputs choose_outputs(const Request& request, const RenderSettings& settings, const std::vector<fs::path>& read) {
    Outputs outputs;
    outputs.images = request.outputs;
    outputs.film = request.film;
    if (request.film_every && !request.film)
        throw UsageError("--film-every: found no --film, expected the film to save so often");
    if (request.shard && !request.film) throw UsageError("--shard: found no --film, expected the film to keep it in");
    if (request.shard && (!request.outputs.empty() || request.error_image))
        throw UsageError("--shard: found an image to write, expected none: develop makes it of all shards' films");
    for (const fs::path& image : outputs.images) require_known_ending(image, "--output");
    if (outputs.images.empty() && !request.shard) {
        const fs::path& own = settings.output;
        if (own.empty())
            throw UsageError(fmt::format("{} names no output, expected --output FILE", read.front().string()));
        require_known_ending(own, read.front().string() + ":/scene/renderer/output");
        outputs.images.push_back(own);
    }
    if (request.error_image) {
        require_known_ending(*request.error_image, "--error-image");
        require_linear(*request.error_image);
        outputs.error_image = request.error_image;
    }
    if (request.stats == "-") {
        outputs.stats_to_standard_output = true;
    } else if (request.stats) {
        outputs.stats = *request.stats;
    }

    std::vector<fs::path> written = outputs.images;
    if (outputs.error_image) written.push_back(*outputs.error_image);
    if (outputs.stats) written.push_back(*outputs.stats);
    if (outputs.film) written.push_back(*outputs.film);
    require_different_files(read, written);
    return outputs;
}

void require_writable(const Outputs& outputs, const RenderSettings& settings) {
    const Window window = settings.window();
    const auto require_image = [&](const fs::path& image) {
        AtomicFile(image, least_file_size(image_format(image), window.width(), window.height()));
    };
    for (const fs::path& image : outputs.images) {
        // A failure is left to AtomicFile, which says more about it.
        std::error_code error;
        if (image == settings.output && image.has_parent_path()) fs::create_directory(image.parent_path(), error);
        require_image(image);
    }
    if (outputs.error_image) require_image(*outputs.error_image);
    if (outputs.stats) AtomicFile{*outputs.stats};
    if (outputs.film) AtomicFile{*outputs.film};
}

}  // namespace orrery
