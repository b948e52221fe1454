// A write that a signal ends half way.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <memory>
#include <stdexcept>

#include "image/atomic_file.hpp"
#include "image/temporaries.hpp"
#include "support/temporary_folder.hpp"
#include "system_faults.hpp"

namespace orrery {
namespace {

using test::SystemCall;
using test::SystemFault;
using test::TemporaryFolder;
using test::to_bytes;
using Names = std::vector<std::string>;

extern "C" void end_on_signal(int) {
    remove_pending_temporaries();
    ::_exit(130);
}

TEST(InterruptedWriteDeathTest, LeavesThePreviousFileAndNoTemporary) {
    const TemporaryFolder folder;
    test::store(folder / "x", to_bytes("old"));
    for (const SystemCall call : {SystemCall::write, SystemCall::fsync, SystemCall::close, SystemCall::rename}) {
        const auto interrupted = [&] {
            std::signal(SIGINT, end_on_signal);
            const SystemFault signal(call, [&] {
                // The temporary is there, or this test shows nothing.
                if (folder.names().size() != 2) ::_exit(1);
                return std::raise(SIGINT);
            });
            write_atomically(folder / "x", to_bytes("new"));
        };
        EXPECT_EXIT(interrupted(), ::testing::ExitedWithCode(130), "");
        EXPECT_EQ(test::load(folder / "x"), "old");
        EXPECT_EQ(folder.names(), Names{"x"});
    }
}

TEST(InterruptedWriteDeathTest, LeavesFinishedFilesAlone) {
    const TemporaryFolder folder;
    const auto finished = [&] {
        write_atomically(folder / "x", to_bytes("new"));
        end_on_signal(SIGINT);
    };
    EXPECT_EXIT(finished(), ::testing::ExitedWithCode(130), "");
    EXPECT_EQ(test::load(folder / "x"), "new");
    EXPECT_EQ(folder.names(), Names{"x"});
}

TEST(InterruptedWriteDeathTest, BeginsNoWriteAfterwards) {
    const TemporaryFolder folder;
    const auto late = [&] {
        remove_pending_temporaries();
        try {
            write_atomically(folder / "x", to_bytes("new"));
        } catch (const std::runtime_error&) {
            ::_exit(7);
        }
        ::_exit(0);
    };
    EXPECT_EXIT(late(), ::testing::ExitedWithCode(7), "");
    EXPECT_TRUE(folder.names().empty());
}

TEST(PendingTemporary, HasRoomForSeveralWritesAndSaysWhenItHasNot) {
    std::vector<std::unique_ptr<PendingTemporary>> pending;
    for (int i = 0; i < 16; ++i) pending.push_back(std::make_unique<PendingTemporary>("/nowhere/x"));
    EXPECT_THROW(PendingTemporary("/nowhere/y"), std::runtime_error);
    pending.pop_back();
    EXPECT_NO_THROW(PendingTemporary("/nowhere/y"));
    EXPECT_THROW(PendingTemporary(std::string(5000, 'x')), std::runtime_error);
}

}  // namespace
}  // namespace orrery
