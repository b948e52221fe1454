// What the system does not grant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "world.hpp"

namespace orrery::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Limits : public ::testing::Test {
protected:
    Limits() {
        store(folder / "world.json", to_bytes(small_world().dump()));
        fs::permissions(folder.path(), fs::perms(0777));  // for whom a limit makes somebody else
    }
    Outcome run(const std::vector<std::string>& arguments, Surroundings surroundings = {}) const {
        surroundings.folder = folder.path();
        return orrery(arguments, surroundings);
    }

    TemporaryFolder folder;
};

TEST_F(Limits, ThreadsThatTheSystemRefusesAreDoneWithout) {
    const std::vector<std::string> arguments = {"render", "world.json", "-o", "few.pfm", "--threads", "64"};
    const Outcome outcome = run(arguments, {.tasks = 4});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr("warning: the system refused "));
    ASSERT_EQ(run({"render", "world.json", "-o", "all.pfm"}).exit_code, 0);
    EXPECT_EQ(load(folder / "few.pfm"), load(folder / "all.pfm"));
}

}  // namespace
}  // namespace orrery::test
