// When the film of a render is saved.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>

#include "wavefront/ledger.hpp"
#include "wavefront/render.hpp"

namespace orrery {

class Saver {
public:
    Saver(const KeepFilm& keep, Ledger& ledger)
        : keep_(keep), ledger_(ledger), before_(ledger.state().seconds), period_(keep.every) {}

    /// Seconds of work on this film, those of earlier runs included.
    double seconds() const { return before_ + seconds_since(start_); }

    /// Saves where the time has come. From any thread that puts nothing meanwhile.
    void tick() {
        if (!keep_.save || seconds_since(start_) < next_) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock) save();
    }

    /// Saves at any rate, all threads being done; `seconds` of work are then in it.
    void finish(double seconds) {
        if (!keep_.save) return;
        ledger_.state().seconds = seconds;
        keep_.save(ledger_);
    }

private:
    using Clock = std::chrono::steady_clock;

    static double seconds_since(Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    }

    void save() {
        const auto begun = Clock::now();
        ledger_.state().seconds = seconds();
        keep_.save(ledger_);
        if (keep_.most_share > 0) period_ = std::max(keep_.every, seconds_since(begun) / keep_.most_share);
        next_ = seconds_since(start_) + period_;
    }

    const KeepFilm& keep_;
    Ledger& ledger_;
    double before_;
    double period_;
    Clock::time_point start_ = Clock::now();
    std::atomic<double> next_ = keep_.every;  ///< seconds after the start
    std::mutex mutex_;
};

}  // namespace orrery
