#include "image/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace orrery {
namespace {

using Channels = std::array<double, 3>;

Channels channels(const Rgb& pixel) { return {pixel.r, pixel.g, pixel.b}; }

bool finite(const Rgb& pixel) { return std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b); }

bool is_error(const Rgb& pixel) { return finite(pixel) && pixel.r >= 0 && pixel.g >= 0 && pixel.b >= 0; }

void require_equal_sizes(const Image& a, const Image* other) {
    if (other && (other->width != a.width || other->height != a.height))
        throw std::invalid_argument("the images differ in size");
}

/// Sums of one row, or of all rows: adding rows to rows keeps the digits of a large image.
struct Sums {
    double squares = 0, relative = 0;
    Channels differences{}, variances{};

    void add(const Sums& row) {
        squares += row.squares;
        relative += row.relative;
        for (std::size_t c = 0; c < 3; ++c) {
            differences[c] += row.differences[c];
            variances[c] += row.variances[c];
        }
    }
};

class Comparer {
public:
    Comparer(const Image& a, const Image& b, const Image* error_a, const Image* error_b)
        : a_(a), b_(b), error_a_(error_a), error_b_(error_b) {}

    Comparison compare() {
        errors_.reserve(3 * a_.pixels.size());
        Sums all;
        for (std::uint32_t y = 0; y < a_.height; ++y) {
            Sums row;
            for (std::uint32_t x = 0; x < a_.width; ++x)
                if (takes_part(x, y)) add(x, y, row);
            all.add(row);
        }
        if (result_.pixels == 0) throw std::invalid_argument("no pixel is finite in all images");
        finish(all);
        return result_;
    }

private:
    bool takes_part(std::uint32_t x, std::uint32_t y) {
        const bool finite_a = finite(a_.at(x, y)), finite_b = finite(b_.at(x, y));
        result_.not_finite_a += !finite_a;
        result_.not_finite_b += !finite_b;
        if (!finite_a || !finite_b) return false;
        const bool known = (!error_a_ || is_error(error_a_->at(x, y))) && (!error_b_ || is_error(error_b_->at(x, y)));
        result_.without_error += !known;
        return known;
    }

    void add(std::uint32_t x, std::uint32_t y, Sums& row) {
        const Channels a = channels(a_.at(x, y)), b = channels(b_.at(x, y));
        for (std::size_t c = 0; c < 3; ++c) {
            const double d = a[c] - b[c];
            row.differences[c] += d;
            row.squares += d * d;
            row.relative += d * d / (b[c] * b[c] + 0.01);
            errors_.push_back(std::abs(d));
            if (std::abs(d) > result_.largest) {
                result_.largest = std::abs(d);
                result_.largest_x = x;
                result_.largest_y = y;
            }
        }
        for (const Image* error : {error_a_, error_b_}) {
            if (!error) continue;
            const Channels e = channels(error->at(x, y));
            for (std::size_t c = 0; c < 3; ++c) row.variances[c] += e[c] * e[c];
        }
        ++result_.pixels;
    }

    void finish(const Sums& sums) {
        const auto pixels = static_cast<double>(result_.pixels);
        result_.mse = sums.squares / (3 * pixels);
        result_.rmse = std::sqrt(result_.mse);
        result_.mrse = sums.relative / (3 * pixels);
        const std::size_t rank = errors_.size() - errors_.size() / 1000;  // ceil(0.999 n), from 1
        const auto nth = errors_.begin() + static_cast<std::ptrdiff_t>(rank - 1);
        std::nth_element(errors_.begin(), nth, errors_.end());
        result_.percentile = *nth;
        for (std::size_t c = 0; c < 3; ++c) {
            result_.channel_difference[c] = sums.differences[c] / pixels;
            result_.mean_difference += result_.channel_difference[c] / 3;
        }
        if (!error_a_ && !error_b_) return;
        Significance& s = result_.significance.emplace();
        // Without any noise a difference is beyond all doubt, and none is none.
        const auto z = [](double d, double error) { return d == 0 ? 0 : d / error; };
        for (std::size_t c = 0; c < 3; ++c) {
            s.channel_error[c] = std::sqrt(sums.variances[c]) / pixels;
            s.channel_z[c] = z(result_.channel_difference[c], s.channel_error[c]);
            s.error += s.channel_error[c] / 3;
        }
        s.z = z(result_.mean_difference, s.error);
    }

    const Image& a_;
    const Image& b_;
    const Image* error_a_;
    const Image* error_b_;
    Comparison result_;
    std::vector<double> errors_;
};

}  // namespace

Comparison compare(const Image& a, const Image& b, const Image* error_a, const Image* error_b) {
    for (const Image* other : {&b, error_a, error_b}) require_equal_sizes(a, other);
    return Comparer(a, b, error_a, error_b).compare();
}

Image difference(const Image& a, const Image& b) {
    require_equal_sizes(a, &b);
    Image result = a;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        Rgb& pixel = result.pixels[i];
        pixel.r -= b.pixels[i].r;
        pixel.g -= b.pixels[i].g;
        pixel.b -= b.pixels[i].b;
    }
    return result;
}

Image visible_difference(const Image& a, const Image& b, double scale) {
    Image result = difference(a, b);
    const auto visible = [&](float d) {
        if (!std::isfinite(d) || scale <= 0) return 0.0f;
        return static_cast<float>(std::min(1.0, std::abs(static_cast<double>(d)) / scale));
    };
    for (Rgb& pixel : result.pixels) pixel = {visible(pixel.r), visible(pixel.g), visible(pixel.b)};
    return result;
}

}  // namespace orrery
