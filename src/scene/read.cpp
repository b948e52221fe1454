#include "scene/read.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <optional>
#include <string>

#include "scene/composition.hpp"
#include "scene/json_text.hpp"
#include "scene/settings.hpp"

namespace orrery {
namespace {

Scene read_root(const JsonTree& tree, const std::filesystem::path& file, Report& report) {
    Scene scene;
    scene.file = file;
    const Node node(tree);
    Fields root(node, "an object with the keys cameras, materials, shapes, lights and scene", report);
    root.ignore("$schema");  // tells editors where the JSON Schema is
    const Registries registries = read_registries(root, find_references(tree), report);

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

ReadResult resolved(const std::optional<JsonTree>& tree, const std::filesystem::path& file, Report& report) {
    std::optional<Scene> scene;
    if (tree) scene = read_root(*tree, file, report);
    if (report.has_errors()) scene.reset();
    return {std::move(scene), report.take()};
}

ReadResult too_large(std::size_t bytes) {
    auto message = bytes == 0 ? "found more text than fits in memory"
                              : fmt::format("found {} bytes of text, expected a scene that fits in memory", bytes);
    return {std::nullopt, {{Severity::error, "", std::move(message)}}};
}

/// The bytes of a file; empty where they cannot be had, which is reported.
std::optional<std::string> contents(const std::filesystem::path& file, Report& report) {
    const auto failure = [&](std::string message) {
        report.add(Severity::error, "", std::move(message));
        return std::nullopt;
    };
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return failure(fmt::format("cannot open this file: {}", std::strerror(errno)));
    std::string text;
    // A growing string holds its bytes twice now and then; a file that knows its size spares that.
    std::error_code unknown;
    if (const auto size = std::filesystem::file_size(file, unknown); !unknown && size <= largest_json)
        text.reserve(size);
    std::array<char, 1 << 16> block;
    while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
        // A reader must end: a device or a pipe that never does is cut off here.
        if (text.size() > largest_json)
            return failure(fmt::format("found more than {} bytes, expected a scene below that", largest_json));
    }
    if (stream.bad()) return failure("cannot read this file; is it a folder?");
    return text;
}

/// The tree has all there is in the text, which is gone on return: the scene takes its place in memory.
std::optional<JsonTree> parse_file(const std::filesystem::path& file, std::size_t& bytes, Report& report) {
    const std::optional<std::string> text = contents(file, report);
    if (!text) return std::nullopt;
    bytes = text->size();
    return parse_json(*text, report);
}

}  // namespace

std::string format_diagnostic(std::string_view file, const Diagnostic& diagnostic) {
    const char* severity = diagnostic.severity == Severity::error ? "error" : "warning";
    if (diagnostic.where.empty()) return fmt::format("{}: {}: {}", file, severity, diagnostic.message);
    return fmt::format("{}:{}: {}: {}", file, diagnostic.where, severity, diagnostic.message);
}

ReadResult read_scene_text(std::string_view text, const std::filesystem::path& file) {
    try {
        Report report;
        return resolved(parse_json(text, report), file, report);
    } catch (const std::bad_alloc&) {
        return too_large(text.size());
    }
}

ReadResult read_scene(const std::filesystem::path& file) {
    std::size_t bytes = 0;
    try {
        Report report;
        return resolved(parse_file(file, bytes, report), file, report);
    } catch (const std::bad_alloc&) {
        return too_large(bytes);
    }
}

}  // namespace orrery
