#include <algorithm>
#include <cmath>

#include "bench/report/plot.hpp"
#include "bench/tradeoff/output.hpp"

namespace orrery::tradeoff {

namespace {

using Point = std::pair<double, double>;

/// Milliseconds of processor time and relative error in per cent.
std::vector<Point> curve(const CellSummary& cell) {
    std::vector<Point> points;
    for (const LevelSummary& level : cell.levels)
        if (level.mrse.value > 0 && level.seconds.value > 0)
            points.emplace_back(1e3 * level.seconds.value, 100 * std::sqrt(level.mrse.value));
    return points;
}

/// The points that none is both faster and better than.
std::vector<Point> pareto_front(std::vector<Point> points) {
    std::ranges::sort(points);
    std::vector<Point> front;
    for (const Point& point : points)
        if (front.empty() || point.second < front.back().second) front.push_back(point);
    return front;
}

std::string error_plot(const Outcome& outcome, std::size_t subject) {
    bench::LinePlot plot{outcome.subjects[subject].name + ": error against time",
                         "milliseconds of processor time",
                         "relative error, per cent",
                         {}};
    std::vector<Point> all;
    for (const CellSummary* cell : outcome.cells_of(subject)) {
        const std::vector<Point> points = curve(*cell);
        all.insert(all.end(), points.begin(), points.end());
        // Combinations count for the front only: as lines they were a thicket. Instruction sets change the time alone.
        if (cell->variant.choices.size() > 1 || cell->variant.chooses("--isa")) continue;
        const std::string name = cell->name.starts_with("--") ? cell->name.substr(2) : cell->name;
        plot.series.push_back({name, points, false, plot.series.size()});
    }
    plot.series.push_back({"best of all settings", pareto_front(std::move(all)), true, plot.series.size()});
    return bench::svg_of(plot);
}

std::string efficiency_plot(const Outcome& outcome) {
    bench::BarPlot plot{"Efficiency over the defaults'", "1 / (MRSE x seconds), relative", {}, {}, {}, true};
    for (const Subject& subject : outcome.subjects) plot.groups.push_back(subject.name);
    plot.values.resize(plot.groups.size());
    for (const Effect& effect : effects_of(outcome)) {
        if (effect.choice.option == "--isa") continue;
        plot.series.push_back(effect.choice.option.substr(2) + " " + effect.choice.word);
        for (auto& values : plot.values) values.push_back(0);
        for (std::size_t i = 0; i < effect.subjects.size(); ++i)
            plot.values[effect.subjects[i]].back() = effect.gains[i].value;
    }
    return bench::svg_of(plot);
}

}  // namespace

std::map<std::string, std::string> plots_of(const Outcome& outcome) {
    std::map<std::string, std::string> plots = {{"tradeoff_efficiency.svg", efficiency_plot(outcome)}};
    for (std::size_t i = 0; i < outcome.subjects.size(); ++i)
        plots["tradeoff_" + outcome.subjects[i].name + ".svg"] = error_plot(outcome, i);
    return plots;
}

}  // namespace orrery::tradeoff
