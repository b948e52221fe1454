#include <array>

#include "bench/report/page.hpp"
#include "bench/report/peers.hpp"
#include "bench/report/plot.hpp"

namespace orrery::bench {

namespace {

constexpr std::array isas = {"sse2", "avx2", "avx512"};
const std::vector<std::string> isa_titles = {"SSE2", "AVX2", "AVX-512"};

/// Ours and Embree over the number of random spheres.
std::string spheres_plot(const Results& results) {
    LinePlot plot{"Random spheres, one thread", "spheres", "million rays per second", {}};
    std::size_t colour = 0;
    for (const char* queue : {"primary", "diffuse", "shadow"}) {
        Series ours{std::string(queue) + ", ours", {}, false, colour};
        Series embree{std::string(queue) + ", Embree", {}, true, colour};
        for (const PeerMatch& match : peer_matches(results)) {
            if (match.queue != queue || !match.scene.starts_with("random-")) continue;
            if (match.ours != nullptr) ours.points.emplace_back(match.spheres, (*match.ours)["Rays/s"] / 1e6);
            if (match.embree != nullptr) embree.points.emplace_back(match.spheres, (*match.embree)["Rays/s"] / 1e6);
        }
        for (Series* series : {&ours, &embree})
            if (!series->points.empty()) plot.series.push_back(std::move(*series));
        ++colour;
    }
    return svg_of(plot);
}

/// Cycles of each stage of a scene, by instruction set: all stages of camera rays, and those that trace later ones.
std::string stages_plot(const Results& results, const std::string& scene) {
    BarPlot plot{"Stages of " + scene + ", stage @ bounce", "cycles per ray", isa_titles, {}, {}, true};
    for (const std::string& stage : results.whats("stage", scene)) {
        if (!stage.ends_with("@0") && !stage.starts_with("intersect") && !stage.starts_with("shadow")) continue;
        plot.groups.push_back(stage);
        plot.values.emplace_back();
        for (const char* isa : isas) {
            const Row* row = results.find("stage", scene, stage, isa);
            plot.values.back().push_back(row != nullptr ? (*row)["cycles/ray"] : 0);
        }
    }
    return svg_of(plot);
}

std::string renders_plot(const Results& results) {
    BarPlot plot{"Whole renders, one thread", "million rays per second", isa_titles, results.subjects("render"), {}};
    for (const std::string& scene : plot.groups) {
        plot.values.emplace_back();
        for (const char* isa : isas) {
            const Row* row = results.find("render", scene, "1", isa);
            plot.values.back().push_back(row != nullptr ? (*row)["Rays/s"] / 1e6 : 0);
        }
    }
    return svg_of(plot);
}

}  // namespace

std::map<std::string, std::string> plots_of(const Results& results) {
    return {{"spheres.svg", spheres_plot(results)},
            {"stages.svg", stages_plot(results, "assignment_08")},
            {"renders.svg", renders_plot(results)}};
}

}  // namespace orrery::bench
