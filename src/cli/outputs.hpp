// Where the images and the statistics go, decided and checked before hours are spent.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/request.hpp"
#include "scene/scene.hpp"

namespace orrery {

struct Outputs {
    std::vector<std::filesystem::path> images;         ///< each of a known ending; none of a shard, else at least one
    std::optional<std::filesystem::path> error_image;  ///< a file that holds linear values
    std::optional<std::filesystem::path> stats;        ///< a file
    std::optional<std::filesystem::path> film;
    bool stats_to_standard_output = false;
};

/// What the command line names; without an image there, the settings' own. Throws UsageError where there is none, an
/// ending is unknown or does not fit, or a file is named twice (as one that is `read`, say: the scene, which comes
/// first). Touches nothing.
Outputs choose_outputs(const Request& request, const RenderSettings& settings,
                       const std::vector<std::filesystem::path>& read);

/// Throws UsageError where two of `written` are one file, under whatever names, or one of them is also `read` or what
/// standard output or error goes to.
void require_different_files(const std::vector<std::filesystem::path>& read,
                             const std::vector<std::filesystem::path>& written);

/// Throws UsageError, which names the `option`, where no image format has the ending of `file`.
void require_known_ending(const std::filesystem::path& file, const std::string& option);

/// Makes sure that all can be written, and makes the folder of the scene's own output where only that folder itself is
/// missing: a scene that says "../output/x.png" does not ask the user to make `output` first. A folder named on the
/// command line is more likely misspelt. Throws std::runtime_error.
void require_writable(const Outputs& outputs, const RenderSettings& settings);

}  // namespace orrery
