// What the system does not grant.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <thread>

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

/// A file of that many bytes that takes none.
void store_sparse(const fs::path& file, std::uintmax_t size) {
    store(file, {});
    fs::resize_file(file, size);
}

TEST_F(Limits, AScenesFileIsRefusedByItsSize) {
    store_sparse(folder / "sparse.json", std::uintmax_t{1} << 40);
    const Outcome outcome = run({"render", "sparse.json", "-o", "x.png"}, {.address_space = rlim_t{1} << 30});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(count_of("\n", outcome.error), 1u) << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr("found 1099511627776 bytes, expected a scene of at most "));
}

TEST_F(Limits, ASceneOfNothingButNulsIsNotReadToItsEnd) {
    store_sparse(folder / "sparse.json", std::uintmax_t{1} << 30);
    for (const char* endless : {"/dev/zero", "sparse.json"}) {
        const Outcome outcome = run({"render", endless, "-o", "x.png"}, {.largest_file = 1 << 20});
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(count_of("\n", outcome.error), 1u) << outcome.error;
        EXPECT_THAT(outcome.error, HasSubstr("1:1: error: found a NUL byte"));
    }
}

#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes of address space and ends the program itself
/// Writes `begin`, and the same part again and again until nobody reads it any more.
void feed_for_ever(const fs::path& pipe, const std::string& begin, const std::string& part) {
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    const int end = ::open(pipe.c_str(), O_WRONLY | O_CLOEXEC);
    bool read = ::write(end, begin.data(), begin.size()) >= 0;
    while (read) read = ::write(end, part.data(), part.size()) > 0;
    ::close(end);
    std::signal(SIGPIPE, before);
}

TEST_F(Limits, OutOfMemoryWhileReadingIsAFailureWithOneMessage) {
    // The text itself, a text within it, lists of numbers, of lists and of texts: each is more than there is room for.
    const std::string blanks(65536, ' '), letters(65536, 'x');
    std::string numbers, lists, texts;
    while (numbers.size() < 65536) numbers += "1,", lists += "[],", texts += "\"twenty letters of text\",";
    const std::pair<std::string, std::string> endless[] = {
        {"", blanks}, {"{\"", letters}, {"[", numbers}, {"[", lists}, {"{\"a\":[", texts}};
    for (const auto& text : endless) {
        fs::remove(folder / "pipe");
        ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
        std::jthread feeder([&] { feed_for_ever(folder / "pipe", text.first, text.second); });
        const Outcome outcome = run({"render", "pipe", "-o", "x.png"}, {.address_space = rlim_t{300} << 20});
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_EQ(outcome.error, "orrery: error: pipe: out of memory while reading this scene\n");
    }
    // Of a size that fits, but not with what it means.
    for (const auto& [begin, part] : endless) {
        std::string text = begin;
        while (text.size() < std::size_t{100} << 20) text += part;
        store(folder / "large.json", to_bytes(text));
        const Outcome outcome = run({"render", "large.json", "-o", "x.png"}, {.address_space = rlim_t{200} << 20});
        if (begin.empty()) {
            EXPECT_EQ(outcome.exit_code, 2) << "blanks mean nothing";
            continue;
        }
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_EQ(outcome.error, "orrery: error: large.json: out of memory while reading this scene\n");
    }
}
#endif

}  // namespace
}  // namespace orrery::test
