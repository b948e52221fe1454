#include "cli/standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include "system/printable.hpp"

namespace orrery {
namespace {

/// Returns 0 or the error.
int write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor, text.data(), text.size());
        if (count < 0 && errno != EINTR) return errno;
        if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

}  // namespace

void occupy_standard_descriptors() {
    // Read-only, so that what is written there still fails; open takes the lowest free number.
    for (int descriptor = 0; descriptor <= 2; ++descriptor)
        if (::fcntl(descriptor, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDONLY));
}

void print_result(std::string_view text) {
    if (const int error = write_all(STDOUT_FILENO, text); error != 0)
        throw std::runtime_error(fmt::format("cannot write to standard output: {}", std::strerror(error)));
}

void print_name(const std::filesystem::path& file) {
    const std::string name = file.string();
    print_result((::isatty(STDOUT_FILENO) != 0 ? printable_whole(name) : name) + "\n");
}

void print_error(std::string_view message) { print_line(fmt::format("orrery: error: {}", message)); }

void print_warning(std::string_view message) { print_line(fmt::format("orrery: warning: {}", message)); }

void print_line(std::string_view text) { print_message(printable_whole(text) + "\n"); }

void print_message(std::string_view text) { write_all(STDERR_FILENO, text); }

}  // namespace orrery
