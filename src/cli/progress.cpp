#include "cli/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "cli/process.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

constexpr std::size_t longest_line = 79;
constexpr std::size_t shortest_bar = 10;

}  // namespace

std::size_t usable_columns() {
    winsize size = {};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return longest_line;
    return std::min<std::size_t>(size.ws_col - 1u, longest_line);
}

std::string duration_text(double seconds) {
    // Beyond a century nobody counts, and the conversion below stays in range.
    const auto whole = static_cast<std::uint64_t>(std::ceil(std::clamp(seconds, 0.0, 3.2e9)));
    constexpr std::uint64_t day = 24 * 3600;
    if (whole >= 2 * day) return fmt::format("{} days", (whole + day / 2) / day);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string progress_line(double fraction, std::uint64_t rays, double seconds, std::size_t columns, double error,
                          double begun) {
    // Rounded down: 100 % is said when all is done.
    std::string figures = fmt::format("{:3} %", static_cast<int>(fraction * 100));
    if (std::isfinite(error)) figures += fmt::format("  error {:.2g} %", 100 * error);
    if (seconds > 0) figures += fmt::format("  {:.1f} Mrays/s", static_cast<double>(rays) / seconds / 1e6);
    if (fraction > begun)
        figures += fmt::format("  {} left", duration_text(seconds * (1 - fraction) / (fraction - begun)));

    constexpr std::size_t frame = 4;  // two brackets, two blanks
    if (columns < figures.size() + frame + shortest_bar) return figures.substr(0, columns);
    const std::size_t bar = columns - figures.size() - frame;
    const auto done = static_cast<std::size_t>(fraction * static_cast<double>(bar));
    return fmt::format("[{}{}]  {}", std::string(done, '#'), std::string(bar - done, '-'), figures);
}

ProgressBar::ProgressBar(bool wanted) : shows_(wanted && ::isatty(STDERR_FILENO) != 0) {}

void ProgressBar::update(double fraction, std::uint64_t rays) {
    if (!shows_) return;
    if (!begun_) begun_ = fraction;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const std::string line = progress_line(fraction, rays, seconds, usable_columns(), error_, *begun_);
    // Blanks over the rest of a longer line before: every terminal knows blanks and \r, not all know more.
    print_message(fmt::format("\r{:<{}}", line, drawn_));
    drawn_ = line.size();
}

void ProgressBar::clear() {
    if (drawn_ > 0) print_message(fmt::format("\r{:{}}\r", "", drawn_));
    drawn_ = 0;
}

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
