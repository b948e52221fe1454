// How far a render is, for whoever asked to be told.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>

#include "wavefront/render.hpp"

namespace orrery {

/// Tells the caller at most ten times a second and from one thread at a time.
class Progress {
public:
    explicit Progress(const RenderOptions& options) : options_(options) {}

    /// What follows is `work` units, which take the render from one share of all to another. Some are done already.
    void begin(double from, double to, double work, double done = 0) {
        from_ = from;
        to_ = to;
        work_ = work;
        done_ = static_cast<std::uint64_t>(done);
        // Whoever foretells what is left must know what was there.
        if (options_.progress) options_.progress(from + (to - from) * (work > 0 ? done / work : 0), rays_);
    }
    void done(std::uint64_t work, std::uint64_t rays) {
        const std::uint64_t done = done_ += work;
        const std::uint64_t total = rays_ += rays;
        if (!options_.progress) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        const auto now = Clock::now();
        const double share = static_cast<double>(done) / work_;
        if (!lock || (share < 1 && now - last_ < std::chrono::milliseconds(100))) return;
        last_ = now;
        options_.progress(from_ + (to_ - from_) * share, total);
    }

private:
    using Clock = std::chrono::steady_clock;
    const RenderOptions& options_;
    double from_ = 0, to_ = 1, work_ = 1;
    std::atomic<std::uint64_t> done_ = 0;
    std::atomic<std::uint64_t> rays_ = 0;
    std::mutex mutex_;
    Clock::time_point last_{};
};

}  // namespace orrery
