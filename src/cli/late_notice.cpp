#include "cli/late_notice.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <system_error>
#include <utility>

#include "cli/progress.hpp"
#include "cli/standard_streams.hpp"
#include "system/printable.hpp"

namespace orrery {

LateNotice::LateNotice(bool wanted, std::string text) {
    if (!wanted || ::isatty(STDERR_FILENO) == 0) return;
    try {
        watch_ =
            std::jthread([this, shown = std::move(text)](const std::stop_token& done) { wait_and_show(done, shown); });
    } catch (const std::system_error&) {
        // The system refuses the thread: the work goes on without a word.
    }
}

void LateNotice::wait_and_show(const std::stop_token& done, const std::string& text) {
    constexpr std::chrono::seconds late(1);
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, done, late, [&] { return done.stop_requested(); })) return;
    const std::string line = printable(printable_whole(text), usable_columns());
    print_message("\r" + line);
    changed_.wait(lock, done, [&] { return done.stop_requested(); });
    print_message(fmt::format("\r{:{}}\r", "", line.size()));
}

}  // namespace orrery
