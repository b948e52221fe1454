#include "oracles.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "plan/coincident.hpp"
#include "scene/read.hpp"
#include "scene_text.hpp"
#include "wavefront/scenes.hpp"

namespace orrery::fuzz {

namespace {

using Images = std::function<Image(const Scene&)>;

struct Way {
    Isa isa = best_isa();
    unsigned threads = 1;
    std::uint32_t wave_size = 64;
    Goal goal{};
    bool may_drop = false;  ///< samples beyond what floats hold
};

bool is_sound(float x) { return std::isfinite(x) && x >= 0; }

Image image_of(const Scene& scene, const Way& way) {
    RenderOptions options;
    options.isa = way.isa;
    options.threads = way.threads;
    options.wave_size = way.wave_size;
    options.goal = way.goal;
    const RenderResult result = orrery::render(Plan(scene), options);
    for (const Rgb& pixel : result.image.pixels)
        if (!is_sound(pixel.r) || !is_sound(pixel.g) || !is_sound(pixel.b))
            throw Finding("a pixel is negative or no number", scene);
    if (!way.may_drop && result.stats.dropped_samples != 0)
        throw Finding(std::to_string(result.stats.dropped_samples) + " samples were no numbers", scene);
    return result.image;
}

/// What the file of a scene is read as, spheres listed twice being one.
Scene read_back(const Scene& scene) {
    const ReadResult result = read_scene_text(scene_text(scene), "scene.json");
    if (!result.scene) {
        for (const Diagnostic& diagnostic : result.diagnostics)
            if (diagnostic.severity == Severity::error)
                throw Finding("a sound scene is refused: " + diagnostic.where + ": " + diagnostic.message, scene);
    }
    return *result.scene;
}

void expect_same(const Image& a, const Image& b, const Scene& scene, const std::string& what) {
    if (a.pixels != b.pixels) throw Finding(what + " makes another image", scene);
}

bool close(float a, float b, double relative) {
    const double x = static_cast<double>(a), y = static_cast<double>(b);
    return std::abs(x - y) <= relative * std::max(x, y) + 1e-30;
}
bool close(const Image& a, const Image& b, double relative) {
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const Rgb &p = a.pixels[i], &q = b.pixels[i];
        if (!close(p.r, q.r, relative) || !close(p.g, q.g, relative) || !close(p.b, q.b, relative)) return false;
    }
    return true;
}

double mean(const Image& image) {
    double sum = 0;
    for (const Rgb& p : image.pixels)
        sum += static_cast<double>(p.r) + static_cast<double>(p.g) + static_cast<double>(p.b);
    return sum / static_cast<double>(3 * image.pixels.size());
}

/// Two ways that round differently have the same expectation. They use the same random numbers, so that most images
/// agree at sight; where one does not, the mean difference over many seeds decides, and then over as many others, so
/// that no single bright path can.
void expect_agreement(Scene scene, const Images& a, const Images& b, double slack, const std::string& what) {
    if (close(a(scene), b(scene), 1e-3)) return;
    std::uint32_t seed = scene.settings.seed + 1;
    double difference = 0, error = 0, level = 0;
    for (const int count : {16, 128, 512}) {
        double sum = 0, squares = 0, levels = 0;
        for (int i = 0; i < count; ++i) {
            scene.settings.seed = seed++;
            const double x = mean(a(scene)), y = mean(b(scene));
            sum += x - y;
            squares += (x - y) * (x - y);
            levels += (x + y) / 2;
        }
        difference = sum / count;
        level = levels / count;
        error = std::sqrt(std::max(squares / count - difference * difference, 0.0) / (count - 1));
        if (std::abs(difference) <= slack * level + 6 * error) return;
    }
    throw Finding(what + " changes the mean by " + std::to_string(difference / level) + " of it, standard error " +
                      std::to_string(error / level),
                  scene);
}

bool shines(const Primitive& p) { return p.emission && *p.emission != glm::dvec3(0); }

void shuffle(std::vector<Primitive>& all, std::uint32_t state) {
    for (std::size_t i = all.size(); i > 1; --i) {
        state = state * 1664525u + 1013904223u;
        std::swap(all[i - 1], all[(state >> 8) % i]);
    }
}

/// Fused multiply-adds round alike.
void same_on_other_sets(const Scene& scene, Way way) {
    const Image image = image_of(scene, way);
    for (const Isa isa : {Isa::scalar, Isa::avx2, Isa::avx512}) {
        if (isa == way.isa || !isa_supported(isa)) continue;
        way.isa = isa;
        expect_same(image, image_of(scene, way), scene, std::string(isa_name(isa)));
    }
}

void same_for_threads_and_waves(const Scene& scene, const Way& way, Choices& choices) {
    Way other = way;
    other.isa = choices.one_of(std::array{best_isa(), Isa::sse2});
    if (!isa_supported(other.isa)) other.isa = best_isa();
    const Image image = image_of(scene, other);
    other.threads = 1 + choices.below(3);
    other.wave_size = choices.one_of(std::array{1u, 33u, 256u, 1000u});
    expect_same(image, image_of(scene, other), scene,
                std::to_string(other.threads) + " threads and waves of " + std::to_string(other.wave_size));
}

/// DEPTH images are of the lengths themselves.
void same_at_other_scales(const Scene& scene, const Way& way, Choices& choices) {
    if (scene.settings.integrator == Integrator::depth) return;
    const int k = choices.one_of(std::array{1, -1, 7, -7, 24, -24, 45, -45});
    const Scene other = test::scaled(scene, k);
    if (!in_range(other) || !in_range(scene)) return;
    expect_same(image_of(scene, way), image_of(other, way), scene, "lengths times 2^" + std::to_string(k));
}

/// Whether spheres are so nearly the same that the plan may take them for one, of which the first listed is kept.
bool listed_almost_twice(const Scene& scene) {
    constexpr double digits = 64 * 0x1p-24;
    const auto found = coincidences(scene.primitives, digits, digits);
    return found.too_many || std::ranges::any_of(found.same, [](const Twins& t) { return t.apart > 0; });
}

/// Whether other numbers than the spheres' own places may depend on the order in which they are listed.
bool order_counts(const Scene& scene) {
    const RenderSettings& s = scene.settings;
    if (listed_almost_twice(scene)) return true;
    if (s.integrator == Integrator::depth) return false;
    if (has_contact(scene)) return true;  // which of two equally near surfaces is met
    if (s.integrator == Integrator::path_tracing && s.transport == Transport::naive) return false;
    return std::any_of(scene.primitives.begin(), scene.primitives.end(), shines);  // lights are numbered
}

/// Where sums and random numbers do not hang on the order, all that may differ is a rounding; where two surfaces meet
/// within one, whole paths may, but not for one seed after the other.
void same_in_another_order(Scene scene, const Way& way, Choices& choices) {
    if (order_counts(scene)) return;
    Scene other = scene;
    shuffle(other.primitives, choices.byte());
    for (int attempt = 0; attempt < 4; ++attempt) {
        other.settings.seed = ++scene.settings.seed;
        if (close(image_of(scene, way), image_of(other, way), 1e-4)) return;
    }
    throw Finding("another order of primitives makes another image", scene);
}

/// Whether every light path ends outside of all glass: what a sphere's inside adds to radiance it then takes again.
bool camera_is_outside_glass(const Scene& scene) {
    return scene.camera.aperture == 0 &&
           std::all_of(scene.primitives.begin(), scene.primitives.end(), [&](const Primitive& p) {
               const MaterialKind kind = scene.materials[p.material].kind;
               return (kind != MaterialKind::dielectric && kind != MaterialKind::translucent) ||
                      glm::length(scene.camera.position - p.centre) > p.radius * (1 + 1e-3);
           });
}

/// In a white world nothing is brighter than white, with reflectances of at most 1, whatever stands in it.
void no_brighter_than_a_furnace(Scene scene, const Way& way) {
    if (scene.settings.integrator == Integrator::depth || !camera_is_outside_glass(scene)) return;
    scene.point_lights.clear();
    for (Primitive& p : scene.primitives) p.emission.reset();
    scene.background = glm::dvec3(1);
    scene.settings.precision = Precision::automatic;
    for (const Rgb& p : image_of(scene, way).pixels)
        if (std::max({p.r, p.g, p.b}) > 1.001f)
            throw Finding("a pixel of " + std::to_string(std::max({p.r, p.g, p.b})) + " in a white furnace", scene);
}

/// One surface, listed twice, up to a rounding: the first counts.
void same_with_a_second_copy(Scene scene, const Way& way, Choices& choices) {
    if (scene.primitives.empty()) return;
    const Scene alone = read_back(scene);
    Primitive copy = choices.one_of(scene.primitives);
    const auto nudged = [&](double x) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return choices.chance(128) ? std::nextafter(x, choices.chance(128) ? infinity : -infinity) : x;
    };
    copy.radius = nudged(copy.radius);
    if (copy.centre.x != 0) copy.centre.x = nudged(copy.centre.x);
    if (copy.centre.z != 0) copy.centre.z = nudged(copy.centre.z);
    copy.material = choices.below(static_cast<std::uint32_t>(scene.materials.size()));
    scene.primitives.push_back(copy);
    expect_same(image_of(alone, way), image_of(read_back(scene), way), scene, "a sphere listed twice");
}

}  // namespace

void check(const DrawnScene& drawn, Choices& choices) {
    const Scene scene = read_back(drawn.scene);
    Way way;
    way.may_drop = drawn.extreme;
    way.isa = choices.one_of(std::array{best_isa(), Isa::avx2, Isa::sse2, Isa::scalar});
    if (!isa_supported(way.isa)) way.isa = Isa::scalar;
    if (choices.chance(40)) {
        way.goal.error = choices.power_of_ten(-2, 0);
        way.goal.samples = 1 + choices.below(40);
        way.goal.adaptive = choices.chance(160);
    }
    Way fused = way;
    if (way.isa == Isa::sse2) fused.isa = Isa::scalar;
    Way with_sse2 = way, with_scalar = way, best = way;
    with_sse2.isa = Isa::sse2;
    with_scalar.isa = Isa::scalar;
    best.isa = best_isa();
    with_sse2.goal = with_scalar.goal = best.goal = {};
    Scene automatic = scene;
    automatic.settings.precision = Precision::automatic;
    switch (choices.below(12)) {
        case 0:
        case 1:
        case 2:
        case 3:
            return same_on_other_sets(scene, fused);
        case 4:
            return same_for_threads_and_waves(scene, way, choices);
        case 5:
            return same_at_other_scales(scene, way, choices);
        case 6:
            return same_in_another_order(scene, way, choices);
        case 7:
            return no_brighter_than_a_furnace(scene, way);
        case 8:
            return same_with_a_second_copy(scene, way, choices);
        case 9:
            return expect_same(image_of(scene, way), image_of(read_back(scene), way), scene, "a file of the scene");
        case 10:
            if (!isa_supported(Isa::sse2)) return;
            return expect_agreement(
                automatic, [&](const Scene& s) { return image_of(s, with_sse2); },
                [&](const Scene& s) { return image_of(s, with_scalar); }, 0.01, "sse2");
        default:
            return expect_agreement(
                automatic, [&](const Scene& s) { return image_of(s, best); },
                [&](Scene s) {
                    s.settings.precision = Precision::binary64;
                    return image_of(s, best);
                },
                0.02, "double");
    }
}

}  // namespace orrery::fuzz
