#include "pseudo_terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace orrery::test {

PseudoTerminal::PseudoTerminal(unsigned short columns) : ours_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (ours_ < 0 || ::grantpt(ours_) != 0 || ::unlockpt(ours_) != 0) throw std::runtime_error("no pseudo terminal");
    name_ = ::ptsname(ours_);
    program_ = ::open(name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (program_ < 0) throw std::runtime_error("cannot open the pseudo terminal");
    const winsize size = {.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    ::ioctl(ours_, TIOCSWINSZ, &size);
}

PseudoTerminal::~PseudoTerminal() {
    ::close(ours_);
    ::close(program_);
}

bool PseudoTerminal::shows(const std::string& text) {
    constexpr int patience = 60'000;
    while (shown_.find(text) == std::string::npos)
        if (!read_more(patience)) return false;
    return true;
}

const std::string& PseudoTerminal::shown() {
    while (read_more(0)) {
    }
    return shown_;
}

bool PseudoTerminal::read_more(int milliseconds) {
    pollfd ready = {.fd = ours_, .events = POLLIN, .revents = 0};
    if (::poll(&ready, 1, milliseconds) <= 0) return false;
    std::array<char, 4096> buffer;
    const ssize_t count = ::read(ours_, buffer.data(), buffer.size());
    if (count <= 0) return false;
    shown_.append(buffer.data(), static_cast<std::size_t>(count));
    return true;
}

}  // namespace orrery::test
