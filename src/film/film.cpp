#include "film/film.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace orrery {

void Film::clear(std::uint32_t width, std::uint32_t height) {
    width_ = width;
    height_ = height;
    const std::size_t pixels = std::size_t{width} * height;
    pixels_.assign(pixels, {});
    spreads_.assign(pixels, {});
    differences_.assign(contrasting_ == Contrasting::one ? pixels : 0, {});
}

void Film::cut(const Tile& tile, Film& patch) const {
    patch.clear(tile.width(), tile.height());
    each_run(tile, width_,
             [&](std::size_t from, std::size_t to, std::uint32_t count) { patch.copy(to, *this, from, count); });
}

void Film::paste(const Tile& tile, const Film& patch) {
    each_run(tile, width_,
             [&](std::size_t to, std::size_t from, std::uint32_t count) { copy(to, patch, from, count); });
}

void Film::copy(std::size_t to, const Film& other, std::size_t from, std::uint32_t count) {
    std::copy_n(other.pixels_.data() + from, count, pixels_.data() + to);
    std::copy_n(other.spreads_.data() + from, count, spreads_.data() + to);
    if (contrasting_ == Contrasting::one)
        std::copy_n(other.differences_.data() + from, count, differences_.data() + to);
}

Film::Content Film::content(std::size_t pixel) const {
    const auto& [r, g, b, samples] = pixels_[pixel];
    return {{r, g, b}, samples, spreads_[pixel], contrasting_ == Contrasting::one ? differences_[pixel] : Rgb64{}};
}

void Film::set_content(std::size_t pixel, const Content& content) {
    pixels_[pixel] = {content.sum.r, content.sum.g, content.sum.b, content.samples};
    spreads_[pixel] = content.spread;
    if (contrasting_ == Contrasting::one) differences_[pixel] = content.difference;
}

Rgb Film::mean(std::size_t pixel) const {
    const Pixel& sum = pixels_[pixel];
    if (sum.samples == 0) return {};
    // Rounded to float once, after the division: the mean of equal samples is that sample.
    const auto count = static_cast<double>(sum.samples);
    return {static_cast<float>(sum.r / count), static_cast<float>(sum.g / count), static_cast<float>(sum.b / count)};
}

Image Film::mean() const {
    Image image{width_, height_, std::vector<Rgb>(pixels_.size())};
    for (std::size_t i = 0; i < pixels_.size(); ++i) image.pixels[i] = mean(i);
    return image;
}

PixelEstimate Film::estimate(std::size_t pixel) const {
    const Pixel& sum = pixels_[pixel];
    const Spread& spread = spreads_[pixel];
    constexpr double unknown = std::numeric_limits<double>::infinity();
    PixelEstimate estimate{{}, {unknown, unknown, unknown}, {}, 0, false};
    if (sum.samples == 0) return estimate;
    const auto n = static_cast<double>(sum.samples);
    estimate.mean = {sum.r / n, sum.g / n, sum.b / n};
    if (spread.members == 0) return estimate;
    const bool one = contrasting_ == Contrasting::one;
    estimate.degrees = one ? 1 : spread.contrasts;
    estimate.blocks = spread.members > 2 * spread.contrasts;
    // The members' sum has the variance of the squares; the sum of all samples has as much more as they are more, and
    // the mean n^2 times less.
    const double scale = 1 / (static_cast<double>(spread.members) * n);
    // The product of two steps is, on average, twice the covariance of square and sum, a contrast's part of the third
    // cumulant.
    const double skew_scale = spread.steps == 0 ? 0 : spread.contrasts / (2.0 * spread.steps) / n;
    for (const auto& [channel, colour] : {std::pair{&Rgb64::r, &Rgb::r}, {&Rgb64::g, &Rgb::g}, {&Rgb64::b, &Rgb::b}}) {
        const double squares = spread.squares.*channel;
        const double difference = one ? differences_[pixel].*channel : 0;
        estimate.variance.*channel = (one ? difference * difference : squares) * scale;
        const double skews = spread.skews.*colour;
        if (squares > 0) estimate.skew.*channel = std::isfinite(skews) ? skews / squares * skew_scale : unknown;
    }
    return estimate;
}

}  // namespace orrery
