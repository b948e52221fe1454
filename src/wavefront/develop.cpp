#include "wavefront/develop.hpp"

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

/// Whether what the pixels around show would make a difference: within two standard errors of such a pixel's mean they
/// change its relative error by a few hundredths up or down, beyond these they are not asked.
bool well_known(const Rgb& value, const Rgb& error) {
    constexpr double little = 1e-4;
    const auto is = [&](double v, double e) { return e * e <= little * (v * v + relative_floor); };
    return is(value.r, error.r) && is(value.g, error.g) && is(value.b, error.b);
}

/// An image whose pixels `value` gives.
template <class Value>
Image image_of(const Film& film, const Developing& how, Value value) {
    Image image{film.width(), film.height(), std::vector<Rgb>(film.pixels())};
    how.team.each(film.height(), [&](std::size_t y, unsigned) {
        how.cancellation.check();
        const std::size_t end = (y + 1) * film.width();
        for (std::size_t i = y * film.width(); i < end; ++i) image.pixels[i] = value(i);
    });
    return image;
}

}  // namespace

Image develop(const Film& film, Integrator integrator, const Developing& how) {
    return image_of(film, how, [&](std::size_t pixel) {
        const Rgb mean = film.mean(pixel);
        if (integrator != Integrator::depth) return mean;
        const float v = inverted(mean.r);
        return Rgb{v, v, v};
    });
}

Image develop_error(const Film& film, Integrator integrator, const Developing& how) {
    return image_of(film, how, [&](std::size_t pixel) { return standard_error(estimate(film, integrator, pixel)); });
}

ErrorSums error_of_tile(const Film& film, Integrator integrator, const Image& image, const Image& errors,
                        const Tile& tile) {
    ErrorSums sums;
    for (std::uint32_t y = tile.y0; y < tile.y1; ++y)
        for (std::uint32_t x = tile.x0; x < tile.x1; ++x)
            if (tile.has(x, y)) {
                const PixelEstimate pixel = estimate(film, integrator, std::size_t{y} * image.width + x);
                const bool known = well_known(image.at(x, y), errors.at(x, y));
                sums.add(pixel, known ? Surroundings{} : surroundings(image, errors, x, y));
            }
    return sums;
}

ImageError estimate_error(const Film& film, Integrator integrator, const Image& image, const Image& errors,
                          const Developing& how) {
    std::vector<ErrorSums> rows(image.height);
    how.team.each(image.height, [&](std::size_t row, unsigned) {
        how.cancellation.check();
        const auto y = static_cast<std::uint32_t>(row);
        rows[row] = error_of_tile(film, integrator, image, errors, {0, y, image.width, y + 1});
    });
    ErrorSums all;
    for (const ErrorSums& row : rows) all.add(row);
    return all.error();
}

}  // namespace orrery
