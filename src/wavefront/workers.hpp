// The threads of a render, each with its wave.
#pragma once

#include <memory>
#include <vector>

#include "system/threads.hpp"
#include "wavefront/progress.hpp"
#include "wavefront/saver.hpp"
#include "wavefront/tile.hpp"

namespace orrery {

template <class Real>
class Workers {
public:
    /// Throws std::invalid_argument where this machine does not run the ISA asked for, or waves are too large.
    Workers(const Plan& plan, const RenderOptions& options, Ledger& ledger, const Cancellation& cancellation);

    /// All tasks of the ledger, in any order. Throws what the cancellation throws.
    void run(Progress& progress, Saver& saver);

    /// For whatever else these threads should do.
    Team& team() { return team_; }

    /// What the threads are, what they counted, and the time since they came.
    void report(RenderStats& stats) const;

private:
    Wave<Real>& wave_of(unsigned member);

    const Plan& plan_;
    const kernels::Stages<Real>& stages_;
    Ledger& ledger_;
    const Cancellation& cancellation_;
    std::uint32_t wave_size_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::uint64_t first_tick_;
    Team team_;
    std::vector<std::unique_ptr<Wave<Real>>> waves_;  ///< by member; null until it has work
};

extern template class Workers<float>;
extern template class Workers<double>;

}  // namespace orrery
