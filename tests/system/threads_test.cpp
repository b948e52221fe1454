// Threads that come, threads that the system refuses, and what they throw.
#include "system/threads.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <set>
#include <stdexcept>

namespace orrery {
namespace {

TEST(Team, DoesEverythingOnce) {
    for (const unsigned wanted : {1u, 2u, 7u}) {
        Team team(wanted);
        EXPECT_EQ(team.size(), wanted);
        EXPECT_EQ(team.refused(), 0u);
        for (const std::size_t count : {0u, 1u, 3u, 1000u}) {
            std::vector<std::atomic<int>> done(count);
            team.each(count, [&](std::size_t i, unsigned member) {
                EXPECT_LT(member, wanted);
                ++done[i];
            });
            for (const auto& times : done) EXPECT_EQ(times, 1);
        }
    }
    EXPECT_EQ(Team(0).size(), processors());
}

// Each waits for all the others: fewer threads than members would wait for ever.
TEST(Team, WorksAtTheSameTime) {
    Team team(4);
    std::atomic<int> here = 0;
    team.each(4, [&](std::size_t, unsigned) {
        ++here;
        while (here < 4) std::this_thread::yield();
    });
    EXPECT_EQ(here, 4);
}

TEST(Team, EndsAtTheFirstExceptionAndGoesOnAfterIt) {
    for (const unsigned wanted : {1u, 3u}) {
        Team team(wanted);
        std::atomic<int> begun = 0;
        const auto fail = [&](std::size_t, unsigned) {
            ++begun;
            throw std::runtime_error("no");
        };
        EXPECT_THROW(team.each(100000, fail), std::runtime_error);
        EXPECT_LE(begun, static_cast<int>(wanted)) << "each thread ends at its own";
        std::atomic<int> done = 0;
        team.each(10, [&](std::size_t, unsigned) { ++done; });
        EXPECT_EQ(done, 10);
    }
}

std::uint64_t sum_of(Fork& fork, std::uint64_t first, std::uint64_t end) {
    if (end - first < 10) {
        std::uint64_t sum = 0;
        for (; first < end; ++first) sum += first;
        return sum;
    }
    const std::uint64_t middle = (first + end) / 2;
    std::uint64_t low = 0, high = 0;
    fork.both([&] { low = sum_of(fork, first, middle); }, [&] { high = sum_of(fork, middle, end); });
    return low + high;
}

TEST(Fork, DoesBothForAnyNumberOfThreads) {
    for (const unsigned threads : {0u, 1u, 2u, 7u}) {
        Fork fork(threads);
        EXPECT_EQ(sum_of(fork, 0, 10000), 10000u * 9999 / 2);
    }
}

TEST(Fork, TakesNoMoreThreadsThanItHas) {
    Fork fork(2);
    std::set<std::thread::id> ids;
    std::mutex mutex;
    const auto here = [&] {
        const std::lock_guard lock(mutex);
        ids.insert(std::this_thread::get_id());
    };
    const auto both = [&] { fork.both(here, here); };
    fork.both(both, both);
    EXPECT_LE(ids.size(), 3u) << "the caller's, and one at a time beside it";
    Fork alone(1);
    ids.clear();
    alone.both(here, here);
    EXPECT_EQ(ids, std::set{std::this_thread::get_id()});
}

TEST(Fork, ThrowsWhatEitherThrows) {
    for (const unsigned threads : {1u, 2u}) {
        Fork fork(threads);
        const auto good = [] {};
        const auto bad = [] { throw std::runtime_error("no"); };
        EXPECT_THROW(fork.both(good, bad), std::runtime_error);
        EXPECT_THROW(fork.both(bad, good), std::runtime_error);
        EXPECT_THROW(fork.both(bad, bad), std::runtime_error);
        EXPECT_NO_THROW(fork.both(good, good));
    }
}

/// Works where the system grants few threads or none, and ends the process with 0 where that went well. Root's threads
/// are not counted, so root becomes somebody else.
[[noreturn]] void work_under_limit(rlim_t most) {
    constexpr uid_t nobody = 65534;
    if (::geteuid() == 0 && ::setuid(nobody) != 0) ::_exit(1);
    const rlimit limit = {most, most};
    if (::setrlimit(RLIMIT_NPROC, &limit) != 0) ::_exit(2);
    Team team(64);
    if (team.refused() == 0 || team.size() + team.refused() != 64) ::_exit(3);
    std::atomic<int> done = 0;
    team.each(1000, [&](std::size_t, unsigned) { ++done; });
    if (done != 1000) ::_exit(4);
    Fork fork(64);
    if (sum_of(fork, 0, 100000) != 100000ull * 99999 / 2) ::_exit(5);
    ::_exit(0);
}

TEST(ThreadsDeathTest, AreDoneWithoutWhereTheSystemRefusesThem) {
    for (const rlim_t most : {1u, 5u}) EXPECT_EXIT(work_under_limit(most), ::testing::ExitedWithCode(0), "") << most;
}

}  // namespace
}  // namespace orrery
