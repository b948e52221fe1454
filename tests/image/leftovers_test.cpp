// Writers that are killed, and those that come after them; writers at the same time.
#include "image/temporaries.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>

#include "image/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include "system/file_descriptor.hpp"
#include "system_faults.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;
using test::load;
using test::store;
using test::SystemCall;
using test::SystemFault;
using test::TemporaryFolder;
using test::to_bytes;
using Names = std::vector<std::string>;

void make_old(const fs::path& file) {
    const timeval times[2] = {{.tv_sec = 1'000'000'000, .tv_usec = 0}, {.tv_sec = 1'000'000'000, .tv_usec = 0}};
    ASSERT_EQ(::utimes(file.c_str(), times), 0);
}

TEST(Leftovers, AreRemovedByTheNextWriter) {
    const TemporaryFolder folder;
    for (int i = 0; i < 3; ++i) store(folder / temporary_name().c_str(), to_bytes("left"));
    write_atomically(folder / "x", to_bytes("new"));
    EXPECT_EQ(folder.names(), Names{"x"});
}

TEST(Leftovers, OfAnotherMachineAreRemovedAfterADay) {
    const TemporaryFolder folder;
    const std::string young = ".orrery-another-1-1.tmp", old = ".orrery-1234-0.tmp";
    store(folder / young.c_str(), to_bytes("left"));
    store(folder / old.c_str(), to_bytes("left"));
    make_old(folder / old.c_str());
    remove_leftovers(folder.path());
    EXPECT_EQ(folder.names(), Names{young});
}

TEST(Leftovers, AreWhatWeMadeAndNothingElse) {
    const TemporaryFolder folder;
    const std::string name = temporary_name();
    store(folder / "orrery.tmp", to_bytes("a file"));
    store(folder / (name + "x").c_str(), to_bytes("a file"));
    store(folder / "target", to_bytes("a file"));
    fs::create_symlink("target", folder / name.c_str());
    fs::create_directory(folder / temporary_name().c_str());
    ASSERT_EQ(::mkfifo((folder / temporary_name().c_str()).c_str(), 0600), 0);
    const Names before = folder.names();
    for (const auto& entry : fs::directory_iterator(folder.path()))
        if (entry.is_regular_file() && !entry.is_symlink()) make_old(entry.path());
    remove_leftovers(folder.path());
    EXPECT_EQ(folder.names(), before);
    EXPECT_NO_THROW(remove_leftovers(folder / "nowhere"));
}

TEST(Leftovers, AreNotTheFilesOfWritersAtWork) {
    const TemporaryFolder folder;
    AtomicFile slow(folder / "slow");
    slow.write(to_bytes("half, "));
    write_atomically(folder / "x", to_bytes("new"));
    slow.write(to_bytes("whole"));
    write_atomically(folder / "x", to_bytes("newer"));
    slow.commit();
    EXPECT_EQ(load(folder / "slow"), "half, whole");
    EXPECT_EQ(folder.names(), (Names{"slow", "x"}));
}

// Between the last flush and the rename the file is closed, but still held.
TEST(Leftovers, AreNotTheFilesOfWritersAboutToRename) {
    const TemporaryFolder folder;
    {
        const SystemFault look(SystemCall::rename, [&] {
            remove_leftovers(folder.path());
            return 0;
        });
        EXPECT_NO_THROW(write_atomically(folder / "x", to_bytes("new")));
    }
    EXPECT_EQ(load(folder / "x"), "new");
}

// Somebody who looks for leftovers finds the new file before its writer holds it, and removes it.
TEST(Leftovers, TakenTooEarlyAreMadeAgain) {
    const TemporaryFolder folder;
    int times = 0;
    bool within = false;
    {
        const SystemFault look(SystemCall::duplicate, [&] {
            if (!within && ++times <= 3) {
                within = true;
                remove_leftovers(folder.path());
                within = false;
            }
            return 0;
        });
        EXPECT_NO_THROW(write_atomically(folder / "x", to_bytes("new")));
    }
    EXPECT_EQ(times, 4);
    EXPECT_EQ(load(folder / "x"), "new");
    EXPECT_EQ(folder.names(), Names{"x"});
}

TEST(Leftovers, StayWhereThereAreNoLocks) {
    const TemporaryFolder folder;
    const std::string left = temporary_name();
    store(folder / left.c_str(), to_bytes("left"));
    {
        const SystemFault none(SystemCall::lock, ENOLCK);
        EXPECT_NO_THROW(write_atomically(folder / "x", to_bytes("new")));
    }
    EXPECT_EQ(folder.names(), (Names{left, "x"}));
}

constexpr std::size_t whole = 300'000;

/// Writes one whole file after another, until it is killed.
[[noreturn]] void write_for_ever(const fs::path& file, char content) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // also where the test itself is killed
    for (;;) write_atomically(file, Bytes(whole, static_cast<std::byte>(content)));
}

void expect_whole(const fs::path& file) {
    const std::string content = load(file);
    EXPECT_EQ(content, std::string(whole, content[0]));
}

// Each by fork and not by exec, so that the kill comes within a write and not within the start of a program.
TEST(KilledWriters, LeaveAWholeFileAndWhatTheNextOneRemoves) {
    const TemporaryFolder folder;
    write_atomically(folder / "x", Bytes(whole, std::byte{'0'}));
    std::mt19937 random(1);
    std::size_t left = 0;
    for (int i = 0; i < 60; ++i) {
        std::vector<pid_t> writers;
        for (int w = 0; w < 2; ++w) {
            writers.push_back(::fork());
            if (writers.back() == 0) write_for_ever(folder / "x", static_cast<char>('a' + i % 20));
        }
        ::usleep(static_cast<useconds_t>(random() % 6000));
        for (const pid_t writer : writers) ::kill(writer, SIGKILL);
        for (const pid_t writer : writers) ::waitpid(writer, nullptr, 0);
        left += folder.names().size() - 1;
        expect_whole(folder / "x");
    }
    EXPECT_GT(left, 0u) << "no kill came within a write";
    write_atomically(folder / "x", Bytes(whole, std::byte{'z'}));
    EXPECT_EQ(folder.names(), Names{"x"});
    expect_whole(folder / "x");
}

/// Ends the process with 0 where all of its writes went well.
[[noreturn]] void write_many(const fs::path& file, char content) {
    try {
        for (int i = 0; i < 100; ++i) write_atomically(file, Bytes(10'000, static_cast<std::byte>(content)));
    } catch (const std::runtime_error&) {
        ::_exit(1);
    }
    ::_exit(0);
}

TEST(TwoWriters, BothSucceed) {
    const TemporaryFolder folder;
    std::vector<pid_t> writers;
    for (const char content : {'a', 'b', 'c'}) {
        writers.push_back(::fork());
        if (writers.back() == 0) write_many(folder / "x", content);
    }
    for (const pid_t writer : writers) {
        int status = 0;
        ::waitpid(writer, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    const std::string content = load(folder / "x");
    EXPECT_EQ(content, std::string(10'000, content[0]));
    EXPECT_EQ(folder.names(), Names{"x"});
}

}  // namespace
}  // namespace orrery
