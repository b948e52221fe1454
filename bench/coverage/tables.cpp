#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "bench/coverage/coverage.hpp"
#include "cli/words.hpp"

namespace orrery::coverage {

namespace {

std::string estimator_of(const Case& tried) { return std::string(word_for(estimator_words, tried.estimator)); }

std::string inside_text(std::uint32_t inside, std::uint32_t renders) {
    const Share share = share_of(inside, renders);
    return fmt::format("{:.1f} % ({:.0f} to {:.0f})", 100.0 * inside / renders, 100 * share.low, 100 * share.high);
}

/// An error to ask of a scene, reached in some hundred samples.
double error_for(const std::string& scene) {
    if (scene == "assignment_01" || scene == "assignment_02") return 0.02;
    return scene == "bench/lamp_behind_glass" ? 1 : scene == "assignment_04" || scene == "assignment_05" ? 0.1 : 0.05;
}

}  // namespace

std::string Case::way() const {
    if (!goal.asked()) return fmt::format("{} samples", samples);
    std::string text =
        goal.error > 0 ? fmt::format("`--error {:g}%", 100 * goal.error) : fmt::format("`--time {:g}s", goal.seconds);
    return text + (goal.adaptive ? "`" : " --adaptive off`");
}

std::vector<Case> all_cases(const std::vector<std::string>& scenes) {
    std::vector<Case> cases;
    for (const std::string& scene : scenes) {
        const double error = error_for(scene);
        for (const Estimator estimator : {Estimator::uniform, Estimator::stratified, Estimator::sobol})
            for (const std::uint32_t samples : {64u, 256u}) cases.push_back({scene, 48, estimator, samples});
        for (const Estimator estimator : {Estimator::stratified, Estimator::sobol})
            cases.push_back({scene, 48, estimator, 64, {.error = error}});
        cases.push_back({scene, 48, Estimator::stratified, 64, {.error = error, .adaptive = false}});
        cases.push_back({scene, 48, Estimator::stratified, 64, {.seconds = 0.05}});
        cases.push_back({scene, 128, Estimator::stratified, 64});
        cases.push_back({scene, 128, Estimator::stratified, 64, {.error = 2 * error}});
    }
    return cases;
}

std::string table_of(const std::vector<Row>& rows) {
    std::string table =
        "| scene | side | estimator | | samples | error made | stated | made / stated | inside | above | below | \"at "
        "least\" | upper end |\n|---|--:|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const Row& row : rows)
        table +=
            fmt::format("| {} | {} | {} | {} | {:.0f} | {:.3g} % | {:.3g} % | {:.3f} | {} | {} | {} | {} | {} |\n",
                        row.tried.scene, row.tried.side, estimator_of(row.tried), row.tried.way(), row.samples,
                        100 * row.made, 100 * row.stated, row.made / row.stated, inside_text(row.inside, row.renders),
                        row.above, row.below, row.open, row.width > 0 ? fmt::format("{:.2f} times", row.width) : "-");
    return table;
}

std::string groups_of(const std::vector<Row>& rows) {
    const auto stopped_by = [](const Row& row) -> std::string {
        const Goal& goal = row.tried.goal;
        return !goal.asked()      ? "samples"
               : goal.seconds > 0 ? "`--time`"
               : goal.adaptive    ? "`--error`"
                                  : "`--error --adaptive off`";
    };
    const std::pair<const char*, std::function<std::string(const Row&)>> keys[] = {
        {"all", [](const Row&) { return std::string("all"); }},
        {"scene", [](const Row& row) { return row.tried.scene; }},
        {"estimator", [](const Row& row) { return estimator_of(row.tried); }},
        {"stopped by", stopped_by},
        {"side", [](const Row& row) { return fmt::format("{} pixels", row.tried.side); }}};
    std::string table = "| | | renders | inside | above | below | \"at least\" |\n|---|---|--:|--:|--:|--:|--:|\n";
    for (const auto& [name, key] : keys) {
        std::vector<std::string> done;
        for (const Row& first : rows) {
            const std::string value = key(first);
            if (std::ranges::find(done, value) != done.end()) continue;
            done.push_back(value);
            Row sum;
            for (const Row& row : rows) {
                if (key(row) != value) continue;
                sum.renders += row.renders;
                sum.inside += row.inside;
                sum.above += row.above;
                sum.below += row.below;
                sum.open += row.open;
            }
            table += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", name, value, sum.renders,
                                 inside_text(sum.inside, sum.renders), sum.above, sum.below, sum.open);
        }
    }
    return table;
}

std::string csv_of(const std::vector<Row>& rows) {
    std::string csv = "scene,side,estimator,way,renders,samples,made,stated,inside,above,below,at_least,width\n";
    for (const Row& row : rows)
        csv += fmt::format("{},{},{},{},{},{:.4g},{:.5g},{:.5g},{},{},{},{},{:.4g}\n", row.tried.scene, row.tried.side,
                           estimator_of(row.tried), row.tried.way(), row.renders, row.samples, row.made, row.stated,
                           row.inside, row.above, row.below, row.open, row.width);
    return csv;
}

}  // namespace orrery::coverage
