#include "worlds/write_world.hpp"

#include <fmt/format.h>

#include <iterator>

namespace orrery::worlds {
namespace {

/// Collects text and passes it on in blocks.
class Blocks {
public:
    explicit Blocks(const Sink& sink) : sink_(sink) {}

    template <class... Values>
    void add(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
        constexpr std::size_t full = std::size_t{1} << 16;
        if (text_.size() >= full) pass_on();
    }

    void pass_on() {
        sink_({text_.data(), text_.size()});
        text_.clear();
    }

private:
    const Sink& sink_;
    fmt::memory_buffer text_;
};

/// Six digits: a sphere's place to a millionth of the world, beyond what an image shows, and short.
std::string triple(const glm::dvec3& v) { return fmt::format("[{:.6g},{:.6g},{:.6g}]", v.x, v.y, v.z); }

void write_registries(const World& world, Blocks& out) {
    out.add(
        "{{\n\"cameras\":[\n{{\"id\":\"camera\",\"type\":\"pinhole\",\"fov\":{:.6g},\"aspect\":1,"
        "\"position\":{},\"target\":{}}}\n],\n\"materials\":[\n",
        world.fov, triple(world.eye), triple(world.target));
    const char* separator = "";
    for (const Paint& paint : world.materials) {
        out.add("{}{{\"id\":\"{}\",\"type\":\"{}\",\"rho\":{}", separator, paint.id, paint.type, triple(paint.rho));
        if (paint.roughness > 0) out.add(",\"roughness\":{:.6g}", paint.roughness);
        out.add("}}");
        separator = ",\n";
    }
    out.add("\n],\n\"lights\":[\n");
    separator = "";
    for (const Lamp& lamp : world.lamps) {
        out.add("{}{{\"id\":\"{}\",\"type\":\"point\",\"position\":{},\"power\":{}}}", separator, lamp.id,
                triple(lamp.position), triple(lamp.intensity));
        separator = ",\n";
    }
    out.add("\n],\n");
}

void write_head_of_scene(const World& world, std::string_view name, Blocks& out) {
    out.add("\"scene\":{{\n\"camera\":\"camera\",\n\"lights\":[");
    const char* separator = "";
    for (const Lamp& lamp : world.lamps) {
        out.add("{}\"{}\"", separator, lamp.id);
        separator = ",";
    }
    out.add(
        "],\n\"background\":{},\n"
        "\"renderer\":{{\"type\":\"PT\",\"dimensions\":[512,512],\"samples\":16,\"depth\":4,"
        "\"output\":\"{}.png\"}},\n",
        triple(world.background), name);
}

}  // namespace

void write_world(const World& world, std::uint64_t spheres, std::string_view name, const Sink& sink) {
    Blocks out(sink);
    write_registries(world, out);
    const auto end = [&](std::uint64_t i) { return i + 1 < spheres ? ",\n" : "\n"; };
    out.add("\"shapes\":[\n");
    for (std::uint64_t i = 0; i < spheres; ++i) {
        const Sphere s = world.sphere(i);
        out.add("{{\"id\":\"s{}\",\"type\":\"sphere\",\"centre\":[{:.6g},{:.6g},{:.6g}],\"radius\":{:.6g}}}{}", i,
                s.centre.x, s.centre.y, s.centre.z, s.radius, end(i));
    }
    out.add("],\n");
    write_head_of_scene(world, name, out);
    out.add("\"primitives\":[\n");
    for (std::uint64_t i = 0; i < spheres; ++i) {
        out.add("{{\"type\":\"geometric\",\"shape\":\"s{}\",\"material\":\"{}\"}}{}", i,
                world.materials[world.sphere(i).material].id, end(i));
    }
    out.add("]\n}}\n}}\n");
    out.pass_on();
}

}  // namespace orrery::worlds
