// JSON scene file -> Scene, or every fault found in it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"

namespace orrery {

enum class Severity : std::uint8_t { warning, error };

struct Diagnostic {
    Severity severity = Severity::error;
    std::string where;    ///< "line:column" for a syntax error, a JSON pointer ("/scene/primitives/3/material") else
    std::string message;  ///< found, expected, nearest known id
};

/// "FILE:where: error: message", the form every diagnostic is printed in.
std::string format_diagnostic(std::string_view file, const Diagnostic& diagnostic);

struct ReadResult {
    std::optional<Scene> scene;           ///< present exactly when no diagnostic is an error
    std::vector<Diagnostic> diagnostics;  ///< all faults of the file, in file order as far as that makes sense
};

/// Reads and resolves a scene, whatever byte string it is; allocates in proportion to the text and throws nothing but
/// std::bad_alloc. `file` names the source in Scene::file and its folder anchors a relative `output`.
ReadResult read_scene_text(std::string_view text, const std::filesystem::path& file);

/// As above from a file; one that cannot be read, or is larger than any scene or than memory, is one error with an
/// empty `where`. Where it is no regular file, but a pipe say, the working directory anchors `output`.
ReadResult read_scene(const std::filesystem::path& file);

}  // namespace orrery
