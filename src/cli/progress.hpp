// What the program is at and how far: a line on the terminal that is gone when the work is done.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace orrery {

/// "[######--------]  42 %  86.3 Mrays/s  1:23 left" in at most `columns` characters: the bar takes what the figures
/// leave. `fraction` in [0, 1], `seconds` since the start, when it was `begun`; `error` of the image so far, where it
/// is finite.
std::string progress_line(double fraction, std::uint64_t rays, double seconds, std::size_t columns,
                          double error = std::numeric_limits<double>::infinity(), double begun = 0);

/// "7 s", "1:23", "4:05:06", and from two days on "28 days".
std::string duration_text(double seconds);

/// How many characters a line on the terminal of standard error may take, at most 79. One less than it has: in the last
/// column many a terminal begins a new line.
std::size_t usable_columns();

class ProgressBar {
public:
    /// Draws nothing where standard error is no terminal, or when it is not `wanted`.
    explicit ProgressBar(bool wanted);
    ~ProgressBar() { clear(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    bool shows() const { return shows_; }
    /// For the next updates.
    void set_error(double error) { error_ = error; }
    void update(double fraction, std::uint64_t rays);

private:
    void clear();

    bool shows_;
    std::optional<double> begun_;  ///< the first fraction
    double error_ = std::numeric_limits<double>::infinity();
    std::size_t drawn_ = 0;  ///< characters on the terminal's line now
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

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
