#include "support/external_program.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

namespace orrery::test {

Bytes output_of(const std::string& command) {
    std::FILE* const pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
    Bytes output;
    std::array<std::byte, 4096> buffer;
    for (std::size_t count; (count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        append(output, ByteView(buffer).first(count));
    if (::pclose(pipe) != 0) throw std::runtime_error("failed: " + command);
    return output;
}

}  // namespace orrery::test
