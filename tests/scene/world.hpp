// A sound scene that uses every kind of entry, for tests to break, and shorthand for reading.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/read.hpp"

namespace orrery::test {

using Json = nlohmann::json;

/// Every camera, material, shape and light type, used and unused ("spare ...") entries, every optional key but `seed`.
/// Reads without a diagnostic.
Json world();

/// Reads a value as if it were the text of `scenes/world.json`.
ReadResult read(const Json& json);

/// All diagnostics, one a line, for failure messages.
std::string listing(const ReadResult& result);

std::filesystem::path scenes_folder();

/// The scene files in scenes/ and below, sorted; the schema is none.
std::vector<std::filesystem::path> scene_files();

}  // namespace orrery::test
