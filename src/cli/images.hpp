// The images of a render to their files.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/outputs.hpp"
#include "cli/reports.hpp"
#include "image/image.hpp"

namespace orrery {

/// `image` to all files that the outputs name for it, `standard_error` to theirs. One file's failure, which is printed,
/// does not keep the others from being written. Returns those that were.
std::vector<std::filesystem::path> write_images(const Outputs& outputs, const Image& image, const Image& standard_error,
                                                const Making& making);

}  // namespace orrery
