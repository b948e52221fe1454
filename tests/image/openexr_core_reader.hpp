// An EXR reader that shares no code with encode_exr: OpenEXRCore, which decode_exr uses too, by lines of its own here.
#pragma once

#include <filesystem>
#include <string>

#include "image/image.hpp"

namespace orrery::test {

struct CoreExr {
    Image image;
    bool all_float = true;                                        ///< every channel is 32-bit float
    std::vector<std::string> channels;                            ///< in file order
    std::vector<std::pair<std::string, std::string>> attributes;  ///< name and type
};

/// Throws std::runtime_error where OpenEXRCore finds a fault.
CoreExr read_with_core(const std::filesystem::path& file);

/// A string attribute.
std::string core_string_attribute(const std::filesystem::path& file, const std::string& name);

}  // namespace orrery::test
