#include "wavefront/develop.hpp"

#include <tbb/parallel_for.h>

#include <vector>

namespace orrery {
namespace {

/// DEPTH's post-process per pixel: 1 - I / (1 + I), written without the cancellation.
float inverted(float distance) { return 1.0f / (1.0f + distance); }

/// A pixel of the image. To first order a distance's error shrinks by the slope of that, its square.
PixelEstimate estimate(const Film& film, Integrator integrator, std::size_t pixel) {
    const PixelEstimate mean = film.estimate(pixel);
    if (integrator != Integrator::depth) return mean;
    const double v = 1 / (1 + mean.mean.r);
    const double variance = mean.variance.r * v * v * v * v, skew = -mean.skew.r * v * v;
    return {{v, v, v}, {variance, variance, variance}, {skew, skew, skew}, mean.degrees, mean.blocks};
}

}  // namespace

Image develop(const Film& film, Integrator integrator) {
    Image image = film.mean();
    if (integrator == Integrator::depth) {
        for (Rgb& p : image.pixels) {
            const float v = inverted(p.r);
            p = {v, v, v};
        }
    }
    return image;
}

Image develop_error(const Film& film, Integrator integrator) {
    Image image{film.width(), film.height(), std::vector<Rgb>(film.pixels())};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, film.pixels(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            image.pixels[i] = standard_error(estimate(film, integrator, i));
    });
    return image;
}

ErrorSums error_of_tile(const Film& film, Integrator integrator, const Image& image, const Image& errors,
                        const Tile& tile) {
    ErrorSums sums;
    for (std::uint32_t y = tile.y0; y < tile.y1; ++y)
        for (std::uint32_t x = tile.x0; x < tile.x1; ++x)
            if (tile.has(x, y)) {
                const PixelEstimate pixel = estimate(film, integrator, std::size_t{y} * image.width + x);
                const Rgb& error = errors.at(x, y);
                const bool noisy = error.r + error.g + error.b > 0;
                sums.add(pixel, noisy ? surroundings(image, errors, x, y) : Surroundings{});
            }
    return sums;
}

ImageError estimate_error(const Film& film, Integrator integrator, const Image& image, const Image& errors) {
    std::vector<ErrorSums> rows(image.height);
    tbb::parallel_for(std::uint32_t{0}, image.height, [&](std::uint32_t y) {
        rows[y] = error_of_tile(film, integrator, image, errors, {0, y, image.width, y + 1});
    });
    ErrorSums all;
    for (const ErrorSums& row : rows) all.add(row);
    return all.error();
}

}  // namespace orrery
