// Scenes made by the program, and rendered by it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace orrery::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Arguments = std::vector<std::string>;

Outcome generate(Arguments arguments, const Surroundings& surroundings = {}) {
    arguments.insert(arguments.begin(), "generate");
    return orrery(arguments, surroundings);
}

TEST(Generate, EveryKindRendersToTheImageItNames) {
    for (const std::string kind : {"random", "lattice", "cluster", "cosmos"}) {
        const TemporaryFolder folder;
        const Outcome written = generate({kind, "--spheres", "50", "-o", "w.json"}, {.folder = folder.path()});
        EXPECT_EQ(written.exit_code, 0);
        EXPECT_EQ(written.output, "w.json\n");
        EXPECT_EQ(written.error, "");
        const Outcome rendered =
            orrery({"render", "w.json", "--size", "16x16", "--spp", "1", "--quiet"}, {.folder = folder.path()});
        EXPECT_EQ(rendered.exit_code, 0) << rendered.error;
        EXPECT_THAT(folder.names(), ElementsAre(kind + ".png", "w.json"));
    }
}

TEST(Generate, StandardOutputAndFileAreTheSameBytes) {
    const TemporaryFolder folder;
    // More than a block, so that pieces are put together.
    const Arguments world = {"random", "--spheres", "2000", "--seed", "3"};
    const auto with = [&](Arguments more) {
        more.insert(more.begin(), world.begin(), world.end());
        return generate(more, {.folder = folder.path()});
    };
    const std::string text = with({}).output;
    EXPECT_THAT(text, StartsWith("{\n\"cameras\""));
    EXPECT_EQ(with({"-o", "-"}).output, text);
    with({"-o", "w.json"});
    EXPECT_EQ(load(folder / "w.json"), text);
    EXPECT_NE(generate({"random", "--spheres", "2000", "--seed", "4"}).output, text);
    EXPECT_EQ(generate({"random", "--spheres", "2000"}).output,
              generate({"random", "--spheres", "2000", "--seed", "0"}).output);
}

TEST(Generate, AFullDiskLeavesThePreviousFileAndNothingElse) {
    const TemporaryFolder folder;
    store(folder / "w.json", to_bytes("previous"));
    const Outcome outcome =
        generate({"random", "--spheres", "5000", "-o", "w.json"}, {.folder = folder.path(), .largest_file = 100'000});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.output, "");
    EXPECT_THAT(outcome.error, AllOf(StartsWith("orrery: error: w.json"), HasSubstr("cannot write")));
    EXPECT_EQ(load(folder / "w.json"), "previous");
    EXPECT_THAT(folder.names(), ElementsAre("w.json"));
}

TEST(Generate, AMissingFolderOrAFullStandardOutputIsAFailure) {
    EXPECT_EQ(generate({"random", "--spheres", "5", "-o", "/no/such/folder/w.json"}).exit_code, 1);
    const Outcome full = generate({"random", "--spheres", "5"}, {.output = "/dev/full"});
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_THAT(full.error, HasSubstr("cannot write to standard output"));
}

TEST(Generate, BadUsageIsNamed) {
    const auto refused = [](const Arguments& arguments, const std::string& why) {
        const Outcome outcome = generate(arguments);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(outcome.output, "");
        EXPECT_THAT(outcome.error, AllOf(HasSubstr(why), HasSubstr("Try: orrery generate --help")));
    };
    refused({}, "KIND is required");
    refused({"random"}, "--spheres is required");
    refused({"randm", "--spheres", "5"}, "found \"randm\", expected random|lattice|cluster|cosmos");
    refused({"random", "--spheres", "0"}, "expected a whole number from 1 to 10000000");
    refused({"random", "--spheres", "10000001"}, "expected a whole number from 1 to 10000000");
    refused({"random", "--spheres", "1e3"}, "found \"1e3\"");
    refused({"random", "--spheres", "5", "--seed", "-1"}, "--seed");
}

TEST(Generate, HelpNamesKindsAndExitCodes) {
    const Outcome help = generate({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.output, AllOf(HasSubstr("random|lattice|cluster|cosmos"), HasSubstr("--spheres N"),
                                   HasSubstr("Exit code"), HasSubstr("orrery render cosmos.json")));
}

}  // namespace
}  // namespace orrery::test
