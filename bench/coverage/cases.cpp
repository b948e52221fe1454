#include <fmt/format.h>

#include "bench/coverage/coverage.hpp"

namespace orrery::coverage {

namespace {

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
        cases.push_back({scene, 48, Estimator::sobol, 64, {.error = error, .adaptive = false}});
        cases.push_back({scene, 48, Estimator::sobol, 64, {.seconds = 0.05}});
        cases.push_back({scene, 128, Estimator::sobol, 64});
        cases.push_back({scene, 128, Estimator::sobol, 64, {.error = 2 * error}});
    }
    return cases;
}

}  // namespace orrery::coverage
