#include <algorithm>
#include <cmath>

#include "bench/coverage/coverage.hpp"
#include "film/error.hpp"
#include "wavefront/render.hpp"

namespace orrery::coverage {

namespace {

/// Mean and sum of squared deviations of every number of the images, from all of them.
struct Moments {
    std::vector<double> mean, squares;
};

using Numbers = std::vector<float>;

Moments moments_of(const std::vector<Numbers>& images) {
    Moments moments{std::vector<double>(images.front().size()), std::vector<double>(images.front().size())};
    double count = 0;
    for (const Numbers& image : images) {
        ++count;
        for (std::size_t i = 0; i < image.size(); ++i) {
            const double step = image[i] - moments.mean[i];
            moments.mean[i] += step / count;
            moments.squares[i] += step * (image[i] - moments.mean[i]);
        }
    }
    return moments;
}

/// Mean over numbers of the squared relative error of one image against the mean of the others.
double squared_error(const Numbers& image, const Moments& all, double images) {
    double sum = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const double step = image[i] - all.mean[i];
        const double to_others = step * images / (images - 1);
        const double squares_of_others = all.squares[i] - step * to_others;
        const double error_of_others = squares_of_others / (images - 2) / (images - 1);
        sum += (to_others * to_others - error_of_others) / (all.mean[i] * all.mean[i] + relative_floor);
    }
    return std::max(sum, 0.0) / static_cast<double>(image.size());
}

/// On a busy machine not even the first pass of a short `--time` may be done in time: the render is asked for again.
RenderResult render_in_time(const Plan& plan, const RenderOptions& options) {
    for (int tries = 1;; ++tries) {
        try {
            return render(plan, options);
        } catch (const NothingInTime&) {
            if (tries == 100) throw;
        }
    }
}

}  // namespace

Row measure(const Scene& scene, const Case& tried, std::uint32_t renders) {
    Row row{.tried = tried, .renders = renders};
    std::vector<Numbers> images;
    std::vector<RootMeanSquare> stated;
    Scene copy = scene;
    copy.settings.width = copy.settings.height = tried.side;
    copy.settings.estimator = tried.estimator;
    copy.settings.samples = tried.samples;
    for (std::uint32_t i = 0; i < renders; ++i) {
        copy.settings.seed = 1 + i;
        RenderOptions options;
        options.goal = tried.goal;
        options.threads = 1;  // small images: threads would wait for each other
        const RenderResult result = render_in_time(Plan(copy), options);
        Numbers& numbers = images.emplace_back();
        for (const Rgb& pixel : result.image.pixels) numbers.insert(numbers.end(), {pixel.r, pixel.g, pixel.b});
        stated.push_back(result.stats.error.relative);
        row.samples += result.stats.samples_per_pixel / renders;
    }
    const Moments moments = moments_of(images);
    double made_squares = 0, stated_squares = 0;
    std::uint32_t closed = 0;
    for (std::uint32_t i = 0; i < renders; ++i) {
        const auto& [value, low, high] = stated[i];
        const double square = squared_error(images[i], moments, renders), made = std::sqrt(square);
        made_squares += square / renders;
        stated_squares += value * value / renders;
        ++(made < low ? row.below : made > high ? row.above : row.inside);
        if (!std::isfinite(high)) {
            if (made >= low) ++row.open;
            continue;
        }
        row.width += value > 0 ? high / value : 1;
        ++closed;
    }
    if (closed > 0) row.width /= closed;
    row.made = std::sqrt(made_squares);
    row.stated = std::sqrt(stated_squares);
    return row;
}

}  // namespace orrery::coverage
