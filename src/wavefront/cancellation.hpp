// Whether the work under way is still wanted: asked from within every loop that may be long.
#pragma once

#include <chrono>
#include <functional>

#include "wavefront/render.hpp"

namespace orrery {

/// A pass has not ended in time.
struct TimeUp {};

class Cancellation {
public:
    using Clock = std::chrono::steady_clock;

    explicit Cancellation(const std::function<bool()>& interrupted) : interrupted_(interrupted) {}

    /// For the work to come. Not while any is under way.
    void set_deadline(Clock::time_point deadline) { deadline_ = deadline; }
    void clear_deadline() { deadline_ = Clock::time_point::max(); }

    /// Throws Interrupted where the caller wants no more, TimeUp behind the deadline. From any thread.
    void check() const {
        if (interrupted_ && interrupted_()) throw Interrupted{};
        if (deadline_ != Clock::time_point::max() && Clock::now() >= deadline_) throw TimeUp{};
    }

private:
    const std::function<bool()>& interrupted_;
    Clock::time_point deadline_ = Clock::time_point::max();
};

}  // namespace orrery
