// Somebody else's programs as judges of our files.
#pragma once

#include <string>

#include "image/codec.hpp"

namespace orrery::test {

/// Runs a shell command and returns what it wrote to standard output. A missing program or a failure is a
/// std::runtime_error, so no test passes because its judge was away.
Bytes output_of(const std::string& command);

}  // namespace orrery::test
