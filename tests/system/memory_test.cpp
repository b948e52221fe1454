// Containers' limits, as /proc and the control groups tell them.
#include "system/memory.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;

/// A root folder of a machine with what a test puts there.
class Machine {
public:
    void put(const std::string& file, const std::string& text) const {
        const fs::path path = root_.path() / file;
        fs::create_directories(path.parent_path());
        test::store(path, test::to_bytes(text));
    }
    std::optional<std::uint64_t> limit() const { return control_group_memory(root_.path()); }

private:
    test::TemporaryFolder root_;
};

constexpr const char* unified = "29 23 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";
constexpr const char* first_version =
    "30 23 0:27 / /sys/fs/cgroup/cpu rw shared:5 - cgroup cgroup rw,cpu,cpuacct\n"
    "31 23 0:28 / /sys/fs/cgroup/memory rw shared:6 - cgroup cgroup rw,memory\n";

TEST(ControlGroup, LimitsMemoryInVersion2) {
    const Machine machine;
    machine.put("proc/self/mountinfo", unified);
    machine.put("proc/self/cgroup", "0::/user.slice/job\n");
    machine.put("sys/fs/cgroup/user.slice/job/memory.max", "314572800\n");
    EXPECT_EQ(machine.limit(), 314572800u);
}

TEST(ControlGroup, LimitsMemoryFromAbove) {
    const Machine machine;
    machine.put("proc/self/mountinfo", unified);
    machine.put("proc/self/cgroup", "0::/a/b/c\n");
    machine.put("sys/fs/cgroup/a/b/c/memory.max", "max\n");
    machine.put("sys/fs/cgroup/a/b/memory.max", "5000\n");
    machine.put("sys/fs/cgroup/a/memory.max", "4000\n");
    machine.put("sys/fs/cgroup/other/memory.max", "10\n");
    EXPECT_EQ(machine.limit(), 4000u);
}

// In a container with a name space of its own the group is "/", and its files are where the host has the topmost.
TEST(ControlGroup, LimitsMemoryWithinAContainer) {
    const Machine machine;
    machine.put("proc/self/mountinfo", unified);
    machine.put("proc/self/cgroup", "0::/\n");
    machine.put("sys/fs/cgroup/memory.max", "7000\n");
    EXPECT_EQ(machine.limit(), 7000u);
}

TEST(ControlGroup, LimitsMemoryInVersion1) {
    const Machine machine;
    machine.put("proc/self/mountinfo", first_version);
    machine.put("proc/self/cgroup", "5:cpu,cpuacct:/x\n4:memory:/docker/1f\n0::/\n");
    machine.put("sys/fs/cgroup/memory/docker/1f/memory.limit_in_bytes", "314572800\n");
    machine.put("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    EXPECT_EQ(machine.limit(), 314572800u);
}

// The host's name of the group beside a mount that shows the group alone, as in Docker.
TEST(ControlGroup, LimitsMemoryWhereTheMountIsTheGroup) {
    const Machine machine;
    machine.put("proc/self/mountinfo",
                "31 23 0:28 /docker/1f /sys/fs/cgroup/memory ro shared:6 - cgroup cgroup rw,memory\n");
    machine.put("proc/self/cgroup", "4:memory:/docker/1f/job\n");
    machine.put("sys/fs/cgroup/memory/memory.limit_in_bytes", "9000\n");
    EXPECT_EQ(machine.limit(), 9000u);
    machine.put("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "8000\n");
    EXPECT_EQ(machine.limit(), 8000u);
    machine.put("proc/self/cgroup", "4:memory:/elsewhere/2\n");
    EXPECT_EQ(machine.limit(), 9000u);
}

TEST(ControlGroup, MayBeMountedAnywhere) {
    const Machine machine;
    machine.put("proc/self/mountinfo", "29 23 0:26 / /my\\040groups rw - cgroup2 none rw\n");
    machine.put("proc/self/cgroup", "0::/a\n");
    machine.put("my groups/a/memory.max", "6000\n");
    EXPECT_EQ(machine.limit(), 6000u);
}

TEST(ControlGroup, IsNoLimitWhereNoneIsSet) {
    const Machine machine;
    EXPECT_EQ(machine.limit(), std::nullopt) << "no /proc";
    std::string mounts = unified;
    mounts.append(first_version).append("garbage\n\n- - -\n");  // with +, GCC 12 warns of its own std::string
    machine.put("proc/self/mountinfo", mounts);
    machine.put("proc/self/cgroup", "0::/a\n4:memory:/b\nnonsense\n:\n");
    EXPECT_EQ(machine.limit(), std::nullopt) << "no files";
    machine.put("sys/fs/cgroup/a/memory.max", "max\n");
    EXPECT_EQ(machine.limit(), std::nullopt);
}

TEST(ControlGroup, IsNotLookedForOutsideItsHierarchy) {
    const Machine machine;
    machine.put("proc/self/mountinfo", unified);
    machine.put("proc/self/cgroup", "0::/../../../outside\n");
    machine.put("outside/memory.max", "1\n");
    machine.put("sys/outside/memory.max", "1\n");
    EXPECT_EQ(machine.limit(), std::nullopt);
}

TEST(Memory, ThisMachineHasSome) {
    EXPECT_GT(memory_limit(), std::uint64_t{64} << 20);
    EXPECT_LT(memory_limit(), std::uint64_t{1} << 60);
}

}  // namespace
}  // namespace orrery
