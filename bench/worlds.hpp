// The scenes that are measured.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "bench/check.hpp"
#include "bench/options.hpp"
#include "bench/recorder.hpp"
#include "scene/scene.hpp"

namespace orrery::bench {

/// `count` spheres of one size, centres uniform in a cube of side 2, seen whole by a pinhole camera outside it and lit
/// by one point light beside that. The radius makes the spheres' volumes add up to a tenth of the cube's, so that how
/// much they overlap does not depend on their number; the share of primary rays that hit grows with it. Diffuse.
Scene random_scene(std::uint32_t count);
/// The radius of its spheres.
double random_scene_radius(std::uint32_t count);

/// What the spheres and what is built over them take.
double table_bytes(const kernels::SphereTable<float>& spheres);

/// The scene `name` (without ".json") of a folder, at 64 samples per pixel and 512 pixels square whatever it asks for.
/// Throws std::runtime_error.
Scene file_scene(const std::filesystem::path& folder, const std::string& name);

class EmbreeScene;

/// A scene with what the benchmarks derive from it, each made when first asked for.
class World {
public:
    World(std::string name, std::function<Scene()> scene, std::uint32_t waves);
    ~World();

    const std::string& name() const { return name_; }
    const Plan& plan();
    const Recording& recording();
    Workspace& workspace();
    /// What `isa` computes wrong in the recorded calls of a stage, empty if nothing (check.hpp). Checked once.
    const std::string& fault(const std::string& stage, std::uint32_t bounce, Isa isa);
    /// The spheres in Embree, set up for closest hits or for occlusion. Only where Embree is built in.
    EmbreeScene& embree(bool occlusion);

private:
    std::string name_;
    std::function<Scene()> scene_;
    std::uint32_t waves_;
    std::unique_ptr<Plan> plan_;
    std::optional<Recording> recording_;
    std::unique_ptr<Workspace> workspace_;
    std::map<std::tuple<std::string, std::uint32_t, Isa>, std::string> faults_;
    std::unique_ptr<EmbreeScene> embree_[2];
};

/// All worlds of a run; benchmarks refer to them.
class Worlds {
public:
    explicit Worlds(const Options& options);
    std::deque<World>& files() { return files_; }
    std::deque<World>& random() { return random_; }

private:
    std::deque<World> files_, random_;
};

}  // namespace orrery::bench
