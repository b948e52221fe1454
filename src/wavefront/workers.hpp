// The threads of a render, each with its wave.
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <span>

#include "wavefront/progress.hpp"
#include "wavefront/tile.hpp"

namespace orrery {

template <class Real>
class Workers {
public:
    /// Throws std::invalid_argument where this machine does not run the ISA asked for.
    Workers(const Plan& plan, const RenderOptions& options, Film& film);

    /// All tasks, no two of which may share a pixel, in any order. Throws Interrupted.
    void run(std::span<const Task> tasks, Progress& progress);

    /// Whatever else these threads should do.
    template <class Work>
    void execute(Work work) {
        arena_.execute(work);
    }

    /// What the threads are, what they counted, and the time since they came.
    void report(RenderStats& stats) const;

private:
    const Plan& plan_;
    const RenderOptions& options_;
    const kernels::Stages<Real>& stages_;
    unsigned threads_;
    std::uint32_t wave_size_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::uint64_t first_tick_;
    tbb::global_control limit_;
    tbb::task_arena arena_;
    tbb::enumerable_thread_specific<Wave<Real>> waves_;
};

extern template class Workers<float>;
extern template class Workers<double>;

}  // namespace orrery
