// What the program is at, for who waits: said only when it takes long.
#pragma once

#include <condition_variable>
#include <string>
#include <thread>

namespace orrery {

/// Shows `text` on the terminal when its owner lives longer than a second, and takes it away with its owner. Silent
/// where standard error is no terminal, or when it is not `wanted`.
class LateNotice {
public:
    LateNotice(bool wanted, std::string text);

private:
    void wait_and_show(const std::stop_token& done, const std::string& text);

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::jthread watch_;  ///< the last member: it ends before what it uses does
};

}  // namespace orrery
