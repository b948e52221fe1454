#include "bench/worlds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "bench/embree_scene.hpp"
#include "scene/read.hpp"

namespace orrery::bench {

double random_scene_radius(std::uint32_t count) {
    constexpr double filled = 0.1;
    return std::cbrt(8 * filled * 3 / (4 * std::numbers::pi * count));
}

Scene random_scene(std::uint32_t count) {
    Scene scene;
    scene.camera.position = {0, 0, -5};
    scene.camera.target = {0, 0, 0};
    scene.camera.fov = 28;
    scene.materials.push_back({.id = "grey", .rho = glm::dvec3{0.8}});
    scene.point_lights.push_back({"light", {-2, 4, -5}, glm::dvec3{100}});
    const double radius = random_scene_radius(count);
    std::mt19937 bits(count);  // its sequence is part of the language, a distribution's is not
    const auto coordinate = [&bits] { return static_cast<double>(bits()) * 0x1p-31 - 1; };
    for (std::uint32_t i = 0; i < count; ++i) {
        const double x = coordinate(), y = coordinate(), z = coordinate();
        scene.primitives.push_back({"", {x, y, z}, radius, 0, {}});
    }
    scene.settings.width = scene.settings.height = 512;
    scene.settings.samples = 64;
    scene.settings.depth = 2;
    scene.settings.roulette = false;
    scene.settings.precision = Precision::binary32;
    return scene;
}

double table_bytes(const kernels::SphereTable<float>& spheres) {
    constexpr double sphere = 8 * 4;  // six numbers and two words
    return sphere * spheres.count + static_cast<double>(sizeof(kernels::TreeNode<float>)) * spheres.tree.count;
}

Scene file_scene(const std::filesystem::path& folder, const std::string& name) {
    const auto file = folder / (name + ".json");
    ReadResult read = read_scene(file);
    if (!read.scene) {
        std::string faults;
        for (const Diagnostic& d : read.diagnostics) faults += format_diagnostic(file.string(), d) + "\n";
        throw std::runtime_error(faults);
    }
    read.scene->settings.width = read.scene->settings.height = 512;
    read.scene->settings.samples = 64;
    read.scene->settings.precision = Precision::binary32;
    return std::move(*read.scene);
}

World::World(std::string name, std::function<Scene()> scene, std::uint32_t waves)
    : name_(std::move(name)), scene_(std::move(scene)), waves_(waves) {}

World::~World() = default;

const Plan& World::plan() {
    if (plan_ == nullptr) plan_ = std::make_unique<Plan>(scene_());
    return *plan_;
}

const Recording& World::recording() {
    if (!recording_) recording_ = record(plan(), waves_);
    return *recording_;
}

Workspace& World::workspace() {
    if (workspace_ == nullptr) workspace_ = std::make_unique<Workspace>(plan(), recording().wave_size);
    return *workspace_;
}

const std::string& World::fault(const std::string& stage, std::uint32_t bounce, Isa isa) {
    const auto [found, is_new] = faults_.try_emplace({stage, bounce, isa});
    if (is_new) found->second = fault_of(recording().of(stage, bounce), kernels::stages_for(isa), workspace());
    return found->second;
}

#if ORRERY_EMBREE
EmbreeScene& World::embree(bool occlusion) {
    auto& scene = embree_[occlusion ? 1 : 0];
    if (scene == nullptr)
        scene =
            std::make_unique<EmbreeScene>(plan().tables().spheres, embree_config(occlusion), RTC_BUILD_QUALITY_HIGH);
    return *scene;
}
#endif

Worlds::Worlds(const Options& options) {
    for (const std::string& name : options.scene_names)
        files_.emplace_back(
            std::filesystem::path(name).filename().string(),
            [name, folder = options.scenes] { return file_scene(folder, name); }, options.waves);
    for (const std::uint32_t count : options.random_counts)
        random_.emplace_back(
            fmt::format("random-{}", count), [count] { return random_scene(count); }, options.waves);
}

}  // namespace orrery::bench
