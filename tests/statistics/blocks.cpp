#include "statistics/blocks.hpp"

#include <algorithm>
#include <stdexcept>

namespace orrery::statistics {

Estimate estimate_of(const RunningMoments& moments) {
    if (moments.count() < 2) throw std::invalid_argument("no standard error from fewer than two samples");
    return {moments.mean(), moments.variance_of_mean(), static_cast<double>(moments.count() - 1)};
}

Estimate weighted_mean(std::span<const Estimate> parts, std::span<const double> weights) {
    double total = 0, sum = 0, variance = 0, spread = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double part = weights[i] * weights[i] * parts[i].variance;
        total += weights[i];
        sum += weights[i] * parts[i].mean;
        variance += part;
        spread += part * part / parts[i].degrees;
    }
    Estimate result{sum / total, variance / (total * total)};
    if (spread > 0) result.degrees = variance * variance / spread;
    return result;
}

double BlockImage::area(std::uint32_t x, std::uint32_t y) const {
    const double across = std::min(block_size, image_width - x * block_size);
    return across * std::min(block_size, image_height - y * block_size);
}

RgbEstimate BlockImage::mean() const {
    RgbEstimate result;
    std::vector<Estimate> parts(blocks.size());
    std::vector<double> weights(blocks.size());
    for (std::size_t channel = 0; channel < 3; ++channel) {
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            parts[i] = blocks[i][channel];
            weights[i] = area(static_cast<std::uint32_t>(i % width()), static_cast<std::uint32_t>(i / width()));
        }
        result[channel] = weighted_mean(parts, weights);
    }
    return result;
}

BlockImage blocks_of_pixels(std::uint32_t width, std::uint32_t height, std::span<const RgbEstimate> pixels,
                            std::uint32_t block_size) {
    if (width == 0 || height == 0 || block_size == 0) throw std::invalid_argument("blocks of an empty image");
    if (pixels.size() != std::size_t{width} * height) throw std::invalid_argument("blocks: wrong number of pixels");
    BlockImage result{width, height, block_size, {}};
    std::vector<Estimate> members;
    for (std::uint32_t top = 0; top < height; top += block_size) {
        for (std::uint32_t left = 0; left < width; left += block_size) {
            RgbEstimate& block = result.blocks.emplace_back();
            for (std::size_t channel = 0; channel < 3; ++channel) {
                members.clear();
                for (std::uint32_t y = top; y < std::min(top + block_size, height); ++y) {
                    for (std::uint32_t x = left; x < std::min(left + block_size, width); ++x) {
                        members.push_back(pixels[std::size_t{y} * width + x][channel]);
                    }
                }
                block[channel] = weighted_mean(members, std::vector<double>(members.size(), 1.0));
            }
        }
    }
    return result;
}

BlockImage blocks_over_seeds(std::span<const Image> images, std::uint32_t block_size) {
    if (images.size() < 2) throw std::invalid_argument("no standard error from fewer than two images");
    const std::uint32_t width = images[0].width, height = images[0].height;
    for (const Image& image : images) {
        if (image.width != width || image.height != height || image.pixels.size() != std::size_t{width} * height) {
            throw std::invalid_argument("blocks: images differ in size");
        }
    }
    std::vector<RgbEstimate> pixels(std::size_t{width} * height);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        std::array<RunningMoments, 3> moments;
        for (const Image& image : images) {
            moments[0].add(image.pixels[i].r);
            moments[1].add(image.pixels[i].g);
            moments[2].add(image.pixels[i].b);
        }
        std::ranges::transform(moments, pixels[i].begin(), estimate_of);
    }
    return blocks_of_pixels(width, height, pixels, block_size);
}

}  // namespace orrery::statistics
