// The whole renderer, scene by scene.
#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <map>

#include "bench/benchmarks.hpp"
#include "bench/timing.hpp"
#include "wavefront/render.hpp"

namespace orrery::bench {

namespace {

/// A scene as it is rendered here.
struct Subject {
    Subject(std::string the_name, Scene scene) : name(std::move(the_name)), plan(std::move(scene)) {}
    std::string name;
    Plan plan;
    std::map<Isa, std::string> faults;  ///< by instruction sets checked
};

Scene sized(Scene scene, std::uint32_t side, std::uint32_t samples) {
    scene.settings.width = scene.settings.height = side;
    scene.settings.samples = samples;
    return scene;
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

const std::string& fault(Subject& subject, Isa isa) {
    const auto [found, is_new] = subject.faults.try_emplace(isa);
    if (is_new) {
        const Plan small(sized(subject.plan.scene(), 48, 4));
        found->second = image_fault(render_with(small, Isa::scalar, 1).image, render_with(small, isa, 1).image, isa);
    }
    return found->second;
}

void run_render(benchmark::State& state, Subject& subject, Isa isa, unsigned threads) {
    if (const std::string& reason = fault(subject, isa); !reason.empty()) return fail(state, reason);
    RenderStats stats;
    const std::vector<Piece> whole{{[] {}, [&] { stats = render_with(subject.plan, isa, threads).stats; }}};
    const auto seconds = time_pieces(state, whole, threads == 1 ? TimedBy::processor : TimedBy::wall);
    set_rates(state, seconds[0], static_cast<double>(stats.closest_rays + stats.shadow_rays));
    state.counters["bytes/ray"] = static_cast<double>(stats.bytes_per_ray);
    state.counters["spheres"] = subject.plan.tables().spheres.count;
    state.counters["wave"] = stats.wave_size;
    state.counters["threads"] = threads;
    state.SetLabel(fmt::format("{} float wave={} spheres={} threads={}", isa_name(isa), stats.wave_size,
                               subject.plan.tables().spheres.count, threads));
}

}  // namespace

void register_renders(const Options& options, Worlds& worlds) {
    const std::uint32_t side = options.smoke ? 32 : 192;
    const std::uint32_t samples = options.smoke ? 4 : 9;
    static std::deque<Subject> subjects;  // benchmarks refer to them until the program ends
    const auto add = [&](std::string name, Scene scene) {
        Subject& subject = subjects.emplace_back(std::move(name), sized(std::move(scene), side, samples));
        const auto add_run = [&](Isa isa, unsigned threads) {
            benchmark::RegisterBenchmark(
                fmt::format("render/{}/{}/{}", subject.name, threads, isa_name(isa)).c_str(),
                [&subject, isa, threads](benchmark::State& state) { run_render(state, subject, isa, threads); })
                ->UseManualTime();
        };
        for (const Isa isa : options.isas) add_run(isa, 1);
        if (options.isas.back() == best_isa()) add_run(best_isa(), 2);
    };
    for (World& world : worlds.files()) {
        add(world.name(), world.plan().scene());
        if (world.name() != "assignment_08") continue;
        Scene scene = world.plan().scene();
        scene.settings.transport = Transport::nee;
        add(world.name() + " nee", std::move(scene));
    }
}

}  // namespace orrery::bench
