// A look at an EXR header before OpenEXR reads it.
#pragma once

#include "image/bytes.hpp"

namespace orrery {

/// Walks the attributes of a single-part scan-line file. OpenEXR allocates what a size field says before it looks
/// whether the file goes on that far, and takes an attribute of a known type to be as long as that type is, whatever
/// its size field says: after this check both agree and the sizes fit the file.
/// Throws std::runtime_error.
void check_exr_header(ByteView file);

}  // namespace orrery
