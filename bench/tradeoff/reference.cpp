#include "bench/tradeoff/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <span>
#include <sstream>

#include "bench/tradeoff/measure.hpp"
#include "film/error.hpp"
#include "image/atomic_file.hpp"
#include "image/image_file.hpp"

namespace fs = std::filesystem;

namespace orrery::tradeoff {

namespace {

constexpr std::uint32_t renders = 4;
constexpr std::uint32_t first_seed = 0x80000000;  // measurements count up from 1

Setup in_double(const RenderSettings& settings) {
    Setup setup{.settings = settings};
    setup.settings.precision = Precision::binary64;
    return setup;
}

/// The mean of renders and its error, channel by channel.
Reference mean_of(const std::vector<Image>& images) {
    Reference reference;
    reference.image = images.front();
    const double n = static_cast<double>(images.size());
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < reference.image.pixels.size(); ++i) {
        double of_pixel = 0;
        for (float Rgb::*channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
            double mean = 0, scatter = 0;
            for (const Image& image : images) mean += image.pixels[i].*channel / n;
            for (const Image& image : images) scatter += std::pow(image.pixels[i].*channel - mean, 2);
            reference.image.pixels[i].*channel = static_cast<float>(mean);
            of_pixel += scatter / (n - 1) / n / (mean * mean + relative_floor) / 3;
        }
        sum += of_pixel;
        squares += of_pixel * of_pixel;
    }
    const double pixels = static_cast<double>(reference.image.pixels.size());
    reference.mrse = sum / pixels;
    // Per pixel: 2 v^2 for the squared error it made, 2 v^2 / 3 for the estimate of v from four renders, whose square
    // is 5/3 v^2 on average.
    reference.mrse_error = std::sqrt(8.0 / 5 * squares) / pixels;
    return reference;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// Where a scene's reference is kept.
fs::path cache_file(const Scene& scene, const RenderSettings& s, const fs::path& folder) {
    const std::string key =
        fmt::format("{} {} {} {} {}", bytes_of(scene.file), s.width, s.height, s.depth, static_cast<int>(s.integrator));
    return folder / fmt::format("{}-{:016x}.pfm", scene.file.stem().string(), std::hash<std::string>()(key));
}

}  // namespace

Reference make_reference(const Scene& scene, const RenderSettings& settings, std::uint32_t strata) {
    const Setup setup = in_double(settings);
    std::vector<Image> images;
    double seconds = 0;
    for (std::uint32_t i = 0; i < renders; ++i) {
        Shot shot = take(scene, setup, strata, first_seed + i);
        seconds += shot.seconds;
        images.push_back(std::move(shot.image));
    }
    Reference reference = mean_of(images);
    reference.samples = double{renders} * strata * strata;
    reference.seconds = seconds;
    return reference;
}

Reference cached_reference(const Scene& scene, const RenderSettings& settings, double processor_seconds,
                           const fs::path& folder) {
    const fs::path image = cache_file(scene, settings, folder);
    const fs::path notes = fs::path(image).replace_extension(".txt");
    Reference reference;
    if (std::ifstream(notes) >> reference.mrse >> reference.mrse_error >> reference.samples >> reference.seconds &&
        reference.seconds >= processor_seconds / 2) {
        reference.image = read_image(image);
        reference.from_cache = true;
        return reference;
    }
    reference = make_reference(scene, settings, strata_for(scene, in_double(settings), processor_seconds / renders));
    fs::create_directories(folder);
    write_image(image, reference.image, ToneMap::none, {});
    const std::string text =
        fmt::format("{} {} {} {}\n", reference.mrse, reference.mrse_error, reference.samples, reference.seconds);
    write_atomically(notes, std::as_bytes(std::span(text)));
    return reference;
}

}  // namespace orrery::tradeoff
