#include "cli/comparison_text.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/json_text.hpp"

namespace orrery {
namespace {

using Json = nlohmann::ordered_json;

/// All figures by name: one list for lines and JSON.
Json figures(const Comparison& c) {
    Json json = {
        {"pixels", c.pixels},
        {"not_finite_a", c.not_finite_a},
        {"not_finite_b", c.not_finite_b},
        {"mse", c.mse},
        {"rmse", c.rmse},
        {"mrse", c.mrse},
        {"largest_error", c.largest},
        {"largest_error_x", c.largest_x},
        {"largest_error_y", c.largest_y},
        {"percentile_99.9_error", c.percentile},
        {"mean_difference", c.mean_difference},
    };
    constexpr const char* names[] = {"r", "g", "b"};
    const auto by_channel = [&](const char* figure, const double(&values)[3]) {
        for (std::size_t i = 0; i < 3; ++i) json[fmt::format("{}_{}", figure, names[i])] = values[i];
    };
    by_channel("mean_difference", c.channel_difference);
    if (const auto& s = c.significance) {
        json["without_error"] = c.without_error;
        json["standard_error"] = s->error;
        by_channel("standard_error", s->channel_error);
        json["z"] = s->z;
        by_channel("z", s->channel_z);
    }
    return json;
}

}  // namespace

std::string comparison_lines(const Comparison& comparison) {
    const Json json = figures(comparison);
    std::string lines;
    for (const auto& figure : json.items()) {
        const Json& value = figure.value();
        const auto add = [&](auto number) {
            fmt::format_to(std::back_inserter(lines), "{} {}\n", figure.key(), number);
        };
        if (value.is_number_float()) {
            add(value.get<double>());
        } else {
            add(value.get<std::uint64_t>());
        }
    }
    return lines;
}

std::string comparison_json(const Comparison& comparison, const ComparisonRequest& request) {
    Json json = {{"a", request.a.string()}, {"b", request.b.string()}};
    json.update(figures(comparison));
    return json_text(json);
}

}  // namespace orrery
