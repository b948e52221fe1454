// The plan in words: `orrery info` and the `plan` entry of the statistics.
#include <fmt/format.h>

#include "plan/plan.hpp"
#include "scene/counted.hpp"
#include "scene/settings.hpp"

namespace orrery {

using kernels::Scattering;

namespace {

const char* name_of(std::uint32_t kind) { return kernels::scattering_traits[kind].name; }

std::string kinds(std::uint32_t mask) {
    std::string list;
    for (std::uint32_t k = 0; k < kernels::scattering_count; ++k)
        if ((mask >> k & 1u) != 0) list += fmt::format("{}{}", list.empty() ? "" : ", ", name_of(k));
    return list;
}

}  // namespace

std::vector<Decision> Plan::decisions() const {
    const Needs& n = needs_;
    const RenderSettings& s = settings();
    std::vector<Decision> list;
    const auto decide = [&](const char* part, bool runs, std::string reason) {
        list.push_back({part, runs, std::move(reason)});
    };
    decide("double precision", s.precision == Precision::binary64, precision_reason_);
    decide("unit of length", unit_.length != 1,
           unit_.length != 1 ? fmt::format("{:.3g}, in the middle of {:.2g} to {:.2g}: all scales compute alike",
                                           unit_.length, unit_.smallest, unit_.largest)
                             : "the scene's own");
    decide("intersect: tree", n.tree,
           n.tree ? fmt::format("{} in {} of sixteen", counted(scene_.primitives.size(), "sphere"),
                                counted(nodes_, "node"))
                  : fmt::format("{}: one loop is faster below {}", counted(scene_.primitives.size(), "sphere"),
                                tree_crossover));
    decide("intersect: packets", n.packets,
           n.packets ? "neighbouring rays that run alike look for their spheres together"
                     : fmt::format("{}: they are sooner tested", counted(scene_.primitives.size(), "sphere")));
    decide("generate: lens", n.lens,
           n.lens ? fmt::format("aperture {}", scene_.camera.aperture) : "the camera is a pinhole");
    decide("random numbers: sobol", n.sobol,
           n.sobol ? "two Sobol' sequences for every decision of a pixel" : "numbers are drawn independently");
    if (n.integrator == Integrator::depth) {
        decide("shade, shadow, roulette", false, "DEPTH stops after intersect");
        return list;
    }
    for (std::uint32_t k = 0; k < kernels::scattering_count; ++k) {
        const bool runs = n.scatters(static_cast<Scattering>(k));
        decide(fmt::format("shade: {}", name_of(k)).c_str(), runs,
               runs ? "some surface scatters so" : "no surface scatters so");
    }
    decide("shade: sort", n.sort, n.sort ? "surfaces scatter in several ways" : "all surfaces scatter alike");
    decide("shade: emission", n.emitters,
           n.emitters ? fmt::format("{} emissive spheres", emitters_) : "no sphere emits");
    decide("shade: background", n.background, n.background ? "rays that miss carry light" : "the background is black");
    decide("shadow: point lights", n.connect_point != 0,
           n.connect_point != 0 ? fmt::format("{} of them, from {} surfaces", point_lights_, kinds(n.connect_point))
           : point_lights_ == 0 ? "there is none"
                                : "no surface they could light");
    const std::string how_bright = s.guide == Guide::automatic
                                       ? fmt::format(": sharp ones are {:.2g} of the light, {:.2g} of all spots'",
                                                     spot_light_.share, spot_light_.sharpness)
                                       : "";
    const bool exact = s.light_sampling == LightSampling::exact;
    const bool naive = n.integrator == Integrator::path_tracing && s.transport == Transport::naive;
    decide("shadow: area lights", n.connect_area != 0,
           n.connect_area != 0 ? fmt::format("{} of them, from {} surfaces{}", emitters_, kinds(n.connect_area),
                                             !n.competing ? ""
                                             : exact      ? ", in place of scattering from outside them"
                                                          : ", weighed against scattering")
           : emitters_ == 0    ? "there is none"
           : naive             ? "naive transport finds them by scattering"
                               : "no surface samples them");
    decide("shadow: closed form", n.exact,
           n.exact  ? "diffuse surfaces get their light without rays, but where several spheres take parts of it"
           : !exact ? fmt::format("light sampling is by {}", text_of(setting("light-sampling"), s))
           : n.connect_area == 0 ? "no area light is sampled"
           : n.tree      ? fmt::format("{}: they are sooner met by rays", counted(scene_.primitives.size(), "sphere"))
           : n.one_light ? "every vertex chooses its light"
                         : "no diffuse surface samples area lights");
    decide("caustics: area lights", n.caustics,
           n.caustics     ? fmt::format("{} over one smooth{} sphere, weighed against what is met by chance",
                                        counted(caustics_.size(), "path"), n.glossy_caustics ? " or glossy" : "")
           : !s.caustics  ? "switched off"
           : !n.competing ? "only where light samples compete with scattering"
           : s.depth < 2
               ? "no path scatters twice"
               : "no smooth sphere apart from a light (nor glossy one, where all lights are sampled by exact), or "
                 "paths find the lights over them by chance");
    decide("caustics: point lights", n.point_caustics,
           n.point_caustics ? fmt::format("over {}, one asked at a vertex; what comes over two or more is left out",
                                          counted(smooth_, "smooth sphere"))
           : n.integrator != Integrator::path_tracing ? "only path tracing has them"
           : n.connect_point == 0                     ? "no surface samples a point light"
           : smooth_ == 0                             ? "no sphere is a mirror or smooth glass"
           : s.depth < 2                              ? "no path scatters twice"
                                                      : "switched off: that light is left out");
    decide("shade: guide", n.guide,
           n.guide ? fmt::format("bounces off diffuse surfaces look for {} that lamps make on diffuse spheres{}",
                                 counted(spots_.size(), "spot"), how_bright)
           : n.integrator == Integrator::whitted ? "diffuse surfaces end a ray"
           : s.guide == Guide::off               ? "switched off"
           : s.depth < 2                         ? "no path is long enough"
           : s.guide == Guide::automatic && std::max(scene_.primitives.size(), point_lights_) > most_spheres_for_spots
               ? fmt::format("not considered among more than {} spheres or lights", most_spheres_for_spots)
           : spots_.empty() ? "no lamp that is sampled makes a spot on a diffuse sphere outside it"
                            : "spots are too dim or too broad" + how_bright);
    const auto lights = sampled_lights();
    decide("shadow: light choice", n.one_light,
           lights == 0                            ? "no light is sampled"
           : lights == 1                          ? "there is one light to sample"
           : n.integrator == Integrator::whitted  ? "Whitted ray tracing takes all lights"
           : s.light_choice == LightChoice::all   ? fmt::format("all {} lights from every vertex", lights)
           : s.light_choice == LightChoice::power ? fmt::format("one of {} lights by power", lights)
                                                  : fmt::format("one of {} lights, all alike", lights));
    decide("roulette: play", n.roulette,
           n.integrator == Integrator::whitted ? "Whitted ray tracing cuts weak branches instead"
           : n.roulette && s.roulette_from > 0
               ? fmt::format("paths of little throughput end, if they have scattered more than {}",
                             counted(s.roulette_from, "time"))
           : n.roulette                ? "paths of little throughput end early"
           : s.roulette && s.depth > 0 ? fmt::format("no path scatters more than {}", counted(s.roulette_from, "time"))
           : s.roulette                ? "no path scatters"
                                       : "switched off; dead rays are still compacted away");
    decide("branches", n.branches, n.branches ? "dielectrics are followed both ways" : "nothing is followed both ways");
    return list;
}

}  // namespace orrery
