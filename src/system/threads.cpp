#include "system/threads.hpp"

#include <sched.h>

#include <algorithm>
#include <utility>

namespace orrery {

unsigned processors() {
    // Beyond 1024 processors the call wants a larger set, and the standard library's answer will do.
    cpu_set_t set;
    if (::sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<unsigned>(std::max(CPU_COUNT(&set), 1));
    return std::max(std::thread::hardware_concurrency(), 1u);
}

Team::Team(unsigned wanted) {
    const unsigned others = (wanted != 0 ? wanted : processors()) - 1;
    threads_.reserve(others);
    try {
        while (threads_.size() < others) {
            const auto member = static_cast<unsigned>(threads_.size()) + 1;
            threads_.emplace_back([this, member] { serve(member); });
        }
    } catch (const std::exception&) {  // std::bad_alloc where there is no room even for the request
        refused_ = others - static_cast<unsigned>(threads_.size());
    }
}

Team::~Team() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    begun_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Team::each(std::size_t count, const Body& body) {
    {
        const std::lock_guard lock(mutex_);
        body_ = &body;
        count_ = count;
        next_ = 0;
        fault_ = nullptr;
        busy_ = static_cast<unsigned>(threads_.size());
        ++round_;
    }
    begun_.notify_all();
    work(0);
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [&] { return busy_ == 0; });
    if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
}

void Team::serve(unsigned member) {
    for (std::size_t seen = 0;;) {
        {
            std::unique_lock lock(mutex_);
            begun_.wait(lock, [&] { return closing_ || round_ != seen; });
            if (closing_) return;
            seen = round_;
        }
        work(member);
        const std::lock_guard lock(mutex_);
        if (--busy_ == 0) ended_.notify_one();
    }
}

void Team::work(unsigned member) {
    try {
        for (std::size_t i; (i = next_++) < count_;) (*body_)(i, member);
    } catch (...) {
        next_ = count_;
        const std::lock_guard lock(mutex_);
        if (!fault_) fault_ = std::current_exception();
    }
}

}  // namespace orrery
