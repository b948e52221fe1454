// Threads, as many as the system grants: where it refuses one, work goes on with fewer.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace orrery {

/// The processors that this process may run on, at least 1.
unsigned processors();

/// Threads that wait for work. Used by one caller at a time.
class Team {
public:
    /// `wanted` members, the calling thread being one of them; 0: one per processor.
    explicit Team(unsigned wanted);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    unsigned size() const { return static_cast<unsigned>(threads_.size()) + 1; }
    unsigned refused() const { return refused_; }  ///< so many fewer than wanted

    /// body(i, member) for every i below `count`, begun in that order by whoever is free; member < size(). Returns when
    /// all is done. After an exception no more is begun; the first is thrown here when what was begun has ended.
    using Body = std::function<void(std::size_t i, unsigned member)>;
    void each(std::size_t count, const Body& body);

private:
    void serve(unsigned member);
    void work(unsigned member);

    std::mutex mutex_;
    std::condition_variable begun_, ended_;
    bool closing_ = false;
    std::size_t round_ = 0;  ///< calls of each()
    unsigned busy_ = 0;      ///< threads at work on the present one
    const Body* body_ = nullptr;
    std::size_t count_ = 0;
    std::atomic<std::size_t> next_ = 0;
    std::exception_ptr fault_;
    unsigned refused_ = 0;
    std::vector<std::thread> threads_;
};

/// For work that parts in two again and again: threads come and go, never more than so many at a time.
class Fork {
public:
    /// 0: one per processor.
    explicit Fork(unsigned threads) : spare_(static_cast<int>(threads != 0 ? threads : processors()) - 1) {}

    /// Does both, at the same time where a thread is to spare, and throws what they throw.
    template <class A, class B>
    void both(const A& a, const B& b) {
        std::future<void> elsewhere = begin(a);
        b();
        if (elsewhere.valid()) {
            elsewhere.get();
        } else {
            a();
        }
    }

private:
    template <class A>
    std::future<void> begin(const A& a) {
        if (--spare_ >= 0) {
            try {
                return std::async(std::launch::async, [this, &a] {
                    const Return spare{spare_};
                    a();
                });
            } catch (const std::exception&) {  // refused
            }
        }
        ++spare_;
        return {};
    }
    struct Return {
        std::atomic<int>& spare;
        ~Return() { ++spare; }
    };

    std::atomic<int> spare_;
};

}  // namespace orrery
