#include "image/file_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <stdexcept>

#include "system/file_descriptor.hpp"

namespace orrery {

Bytes read_file(const std::filesystem::path& file, std::uint64_t most) {
    // O_NONBLOCK: opening a pipe must not wait for a writer, it is refused below.
    const FileDescriptor input(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!input.is_open()) throw_system_error(file, "cannot open", errno);
    struct stat status = {};
    if (::fstat(input.number(), &status) != 0) throw_system_error(file, "cannot read", errno);
    if (!S_ISREG(status.st_mode)) throw std::runtime_error(fmt::format("{}: not a regular file", file.string()));

    if (static_cast<std::uint64_t>(status.st_size) > most)
        throw std::runtime_error(
            fmt::format("{}: found {} bytes, and {} of memory are left", file.string(), status.st_size, most));

    Bytes bytes(static_cast<std::size_t>(status.st_size));
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        const ssize_t count = ::read(input.number(), bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw_system_error(file, "cannot read", errno);
        if (count == 0) break;  // somebody cut it meanwhile
        filled += static_cast<std::size_t>(count);
    }
    bytes.resize(filled);
    return bytes;
}

}  // namespace orrery
