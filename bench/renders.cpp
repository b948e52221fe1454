// The whole renderer, scene by scene.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "bench/benchmarks.hpp"
#include "bench/timing.hpp"
#include "wavefront/render.hpp"

namespace orrery::bench {

namespace {

/// A scene as it is rendered here.
struct Subject {
    std::string name;
    Scene scene;
};

Subject subject(std::string name, Scene scene, std::uint32_t side, std::uint32_t samples) {
    scene.settings.width = scene.settings.height = side;
    scene.settings.samples = samples;
    return {std::move(name), std::move(scene)};
}

RenderResult render_with(const Plan& plan, Isa isa, unsigned threads) {
    RenderOptions options;
    options.isa = isa;
    options.threads = threads;
    return render(plan, options);
}

/// Pixels of SSE2, which has no fused multiply-add, that may differ by more than 1e-3 from the scalar renderer's: those
/// where a rounding turned a grazing hit or a random choice of one of the samples.
constexpr double tolerated_share = 0.03;

std::string image_fault(const Image& scalar, const Image& found, Isa isa) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < scalar.pixels.size(); ++i) {
        const Rgb &a = scalar.pixels[i], &b = found.pixels[i];
        const auto far = [](float x, float y) { return std::abs(x - y) > 1e-3f * std::max(1.0f, std::abs(x)); };
        const bool differs = isa == Isa::sse2 ? far(a.r, b.r) || far(a.g, b.g) || far(a.b, b.b) : !(a == b);
        different += differs ? 1 : 0;
    }
    const double tolerated = isa == Isa::sse2 ? tolerated_share * static_cast<double>(scalar.pixels.size()) : 0;
    if (static_cast<double>(different) <= tolerated) return {};
    return fmt::format("{} of {} pixels are not the scalar renderer's", different, scalar.pixels.size());
}

void run_render(benchmark::State& state, const Scene& scene, Isa isa, unsigned threads) {
    const Plan small(subject("", scene, 48, 4).scene);
    const Image scalar = render_with(small, Isa::scalar, 1).image;
    if (const auto fault = image_fault(scalar, render_with(small, isa, threads).image, isa); !fault.empty())
        return fail(state, fault);
    const Plan plan(scene);
    RenderStats stats;
    const double rays = [&] {
        stats = render_with(plan, isa, threads).stats;
        return static_cast<double>(stats.closest_rays + stats.shadow_rays);
    }();
    // On one thread the processor time, which tenants of the machine do not add to.
    time_passes(state, {{[] {}, [&] { render_with(plan, isa, threads); }}}, rays,
                threads == 1 ? TimedBy::processor : TimedBy::wall);
    state.counters["bytes/ray"] = static_cast<double>(stats.bytes_per_ray);
    state.counters["spheres"] = plan.spheres().count;
    state.counters["wave"] = stats.wave_size;
    state.counters["threads"] = threads;
    state.SetLabel(fmt::format("{} float wave={} spheres={} threads={}", isa_name(isa), stats.wave_size,
                               plan.spheres().count, threads));
}

}  // namespace

void register_renders(const Options& options, Worlds& worlds) {
    const std::uint32_t side = options.smoke ? 32 : 256;
    const std::uint32_t samples = options.smoke ? 4 : 16;
    static std::vector<Subject> subjects;  // benchmarks refer to it until the program ends
    for (World& world : worlds.files()) {
        subjects.push_back(subject(world.name(), world.plan().scene(), side, samples));
        if (world.name() != "assignment_08") continue;
        subjects.push_back(subjects.back());
        subjects.back().name += " nee";
        subjects.back().scene.settings.transport = Transport::nee;
    }
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        const auto add = [&](Isa isa, unsigned threads) {
            benchmark::RegisterBenchmark(
                fmt::format("render/{}/{}/{}", subjects[i].name, threads, isa_name(isa)).c_str(),
                [i, isa, threads](benchmark::State& state) { run_render(state, subjects[i].scene, isa, threads); })
                ->UseManualTime();
        };
        for (const Isa isa : options.isas) add(isa, 1);
        if (options.isas.back() == best_isa()) add(best_isa(), 2);
    }
}

}  // namespace orrery::bench
