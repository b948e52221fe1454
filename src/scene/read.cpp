#include "scene/read.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>

#include "scene/composition.hpp"
#include "scene/json_text.hpp"
#include "scene/settings.hpp"

namespace orrery {
namespace {

/// A reader must end: a device or a pipe that never does is cut off here. Four million spheres take about this much.
constexpr std::size_t largest_file = std::size_t{1} << 30;

Scene read_root(const Json& json, const std::filesystem::path& file, Report& report) {
    Scene scene;
    scene.file = file;
    const Node node(json);
    Fields root(node, "an object with the keys cameras, materials, shapes, lights and scene", report);
    root.ignore("$schema");  // tells editors where the JSON Schema is
    const Registries registries = read_registries(root, find_references(json), report);

    if (const auto composition = root.any("scene", "a scene object")) {
        Fields fields(*composition, "a scene object", report);
        read_composition(fields, registries, report, scene);
        if (const auto renderer = fields.any("renderer", "a renderer object")) {
            scene.settings = read_settings(*renderer, file.parent_path(), report);
        }
        fields.finish();
    }
    root.finish();
    return scene;
}

ReadResult failure(std::string message) { return {std::nullopt, {{Severity::error, "", std::move(message)}}}; }

}  // namespace

std::string format_diagnostic(std::string_view file, const Diagnostic& diagnostic) {
    const char* severity = diagnostic.severity == Severity::error ? "error" : "warning";
    if (diagnostic.where.empty()) return fmt::format("{}: {}: {}", file, severity, diagnostic.message);
    return fmt::format("{}:{}: {}: {}", file, diagnostic.where, severity, diagnostic.message);
}

ReadResult read_scene_text(std::string_view text, const std::filesystem::path& file) {
    try {
        Report report;
        std::optional<Scene> scene;
        if (const std::optional<Json> json = parse_json(text, report)) scene = read_root(*json, file, report);
        if (report.has_errors()) scene.reset();
        return {std::move(scene), report.take()};
    } catch (const std::bad_alloc&) {
        return failure(fmt::format("found {} bytes of text, expected a scene that fits in memory", text.size()));
    }
}

ReadResult read_scene(const std::filesystem::path& file) {
    try {
        std::ifstream stream(file, std::ios::binary);
        if (!stream) return failure(fmt::format("cannot open this file: {}", std::strerror(errno)));
        std::string text;
        std::array<char, 1 << 16> block;
        while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
            text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
            if (text.size() > largest_file) {
                return failure(fmt::format("found more than {} bytes, expected a scene below that", largest_file));
            }
        }
        if (stream.bad()) return failure("cannot read this file; is it a folder?");
        return read_scene_text(text, file);
    } catch (const std::bad_alloc&) {
        return failure("found more text than fits in memory");
    }
}

}  // namespace orrery
