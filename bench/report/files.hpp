// Whole files of text, as the benchmarks' reports read and write them.
#pragma once

#include <filesystem>
#include <string>

namespace orrery::bench {

/// Throws std::runtime_error where it cannot be read.
std::string text_of(const std::filesystem::path& file);

/// Makes the folder where it is missing, and replaces the file in one step. Throws std::runtime_error (or
/// std::filesystem::filesystem_error) where it cannot.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace orrery::bench
