#include "image/atomic_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

#include "support/temporary_folder.hpp"
#include "system/file_descriptor.hpp"
#include "system_faults.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;
using test::load;
using test::SystemCall;
using test::SystemFault;
using test::TemporaryFolder;
using test::to_bytes;
using Names = std::vector<std::string>;

/// What writing complains about, "none" where it does not.
std::string fault_of(const fs::path& file, std::size_t size = 3) {
    try {
        write_atomically(file, Bytes(size, std::byte{'n'}));
        return "none";
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
}

mode_t mode_of(const fs::path& file) {
    struct stat status = {};
    EXPECT_EQ(::stat(file.c_str(), &status), 0);
    return status.st_mode & mode_t{07777};
}

TEST(AtomicFile, WritesAndReplaces) {
    const TemporaryFolder folder;
    write_atomically(folder / "x", to_bytes("first, longer"));
    EXPECT_EQ(load(folder / "x"), "first, longer");
    write_atomically(folder / "x", to_bytes("second"));
    EXPECT_EQ(load(folder / "x"), "second");
    write_atomically(folder / "x", {});
    EXPECT_EQ(load(folder / "x"), "");
    EXPECT_EQ(folder.names(), Names{"x"});
}

TEST(AtomicFile, TakesANameWithoutAFolder) {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    write_atomically("x", to_bytes("here"));
    fs::current_path(before);
    EXPECT_EQ(load(folder / "x"), "here");
}

TEST(AtomicFile, TakesTheLongestNameAFolderHolds) {
    const TemporaryFolder folder;
    const std::string name(255, 'x');
    EXPECT_EQ(fault_of(folder / name.c_str()), "none");
    EXPECT_EQ(folder.names(), Names{name});
}

TEST(AtomicFile, GivesANewFileTheModeTheUmaskAllows) {
    const TemporaryFolder folder;
    const mode_t before = ::umask(027);
    write_atomically(folder / "x", to_bytes("x"));
    ::umask(before);
    EXPECT_EQ(mode_of(folder / "x"), mode_t{0640});
}

TEST(AtomicFile, KeepsTheModeOfTheFileItReplaces) {
    const TemporaryFolder folder;
    for (const mode_t mode : {mode_t{0600}, mode_t{0664}}) {
        test::store(folder / "x", to_bytes("old"));
        ASSERT_EQ(::chmod((folder / "x").c_str(), mode), 0);
        write_atomically(folder / "x", to_bytes("new"));
        EXPECT_EQ(mode_of(folder / "x"), mode);
    }
}

TEST(AtomicFile, FollowsLinks) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "data");
    fs::create_symlink("data/x", folder / "link");
    fs::create_symlink(folder / "link", folder / "link to link");
    EXPECT_EQ(fault_of(folder / "link to link"), "none");  // leads to nothing yet
    write_atomically(folder / "link", to_bytes("new"));
    EXPECT_EQ(load(folder / "data" / fs::path("x")), "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_TRUE(fs::is_symlink(folder / "link to link"));
    EXPECT_EQ(folder.names(), (Names{"data", "link", "link to link"}));
}

TEST(AtomicFile, RefusesALoopOfLinks) {
    const TemporaryFolder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    EXPECT_EQ(fault_of(folder / "a"),
              (folder / "a").string() + ": cannot follow the link: Too many levels of symbolic links");
}

TEST(AtomicFile, NamesAMissingFolder) {
    const TemporaryFolder folder;
    const std::string file = (folder / "no" / fs::path("x.ppm")).string();
    EXPECT_EQ(fault_of(file), file + ": the folder " + (folder / "no").string() + " does not exist");
}

TEST(AtomicFile, RefusesWhatIsNotARegularFile) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "d");
    EXPECT_EQ(fault_of(folder / "d"), (folder / "d").string() + ": is a directory");
    EXPECT_EQ(fault_of(folder / "d/"), (folder / "d/").string() + ": is a directory");
    fs::create_symlink("/dev/null", folder / "null");
    EXPECT_EQ(fault_of(folder / "null"), (folder / "null").string() + ": not a regular file");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    test::store(folder / "f", to_bytes("f"));
    EXPECT_NE(fault_of(folder / "f" / fs::path("x")), "none");
    EXPECT_EQ(folder.names(), (Names{"d", "f", "null"}));
}

/// Ends the process with 0 where neither a protected file is replaced nor one made in a protected folder. As root
/// nothing is protected, so root gives up its rights first; the folder is root's then and closed to it.
[[noreturn]] void try_protected(const TemporaryFolder& folder) {
    constexpr uid_t nobody = 65534;
    const bool root = ::geteuid() == 0;
    if (root && ::seteuid(nobody) != 0) ::_exit(1);
    const std::string replacing = fault_of(folder / "protected");
    if (!root) fs::permissions(folder.path(), fs::perms(0555));
    const std::string making = fault_of(folder / "x");
    if (!root) fs::permissions(folder.path(), fs::perms(0755));
    const std::string path = folder.path().string();
    if (replacing != path + "/protected: cannot be replaced: Permission denied") ::_exit(2);
    if (making != path + "/x: cannot write to the folder " + path + ": Permission denied") ::_exit(3);
    ::_exit(0);
}

TEST(AtomicFileDeathTest, RefusesAFolderOrAFileThatIsProtected) {
    const TemporaryFolder folder;
    test::store(folder / "protected", to_bytes("old"));
    fs::permissions(folder / "protected", fs::perms(0444));
    EXPECT_EXIT(try_protected(folder), ::testing::ExitedWithCode(0), "");
    EXPECT_EQ(load(folder / "protected"), "old");
    EXPECT_EQ(folder.names(), Names{"protected"});
}

// The kernel's own refusal in the middle of the data: the limit of a file's size, which takes no privilege.
TEST(AtomicFile, LeavesThePreviousFileWhenTheDataDoNotFit) {
    const TemporaryFolder folder;
    test::store(folder / "x", to_bytes("old"));
    rlimit before = {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit tight = {10000, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
    std::string fault;
    try {
        AtomicFile file(folder / "x");  // which does not know how much will come
        file.write(Bytes(20000));
        file.commit();
    } catch (const std::runtime_error& error) {
        fault = error.what();
    }
    const std::string announced = fault_of(folder / "x", 20000);
    const std::string fits = fault_of(folder / "y", 10000);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(fault, (folder / "x").string() + ": cannot write: File too large");
    EXPECT_EQ(announced, (folder / "x").string() + ": takes 20000 bytes, and files may have 10000");
    EXPECT_EQ(fits, "none");
    EXPECT_EQ(load(folder / "x"), "old");
    EXPECT_EQ(folder.names(), (Names{"x", "y"}));
}

TEST(AtomicFile, LeavesThePreviousFileWhateverCallFails) {
    const TemporaryFolder folder;
    test::store(folder / "x", to_bytes("old"));
    const std::string file = (folder / "x").string();
    for (const SystemCall call : {SystemCall::write, SystemCall::fsync, SystemCall::close}) {
        const SystemFault full(call, ENOSPC);
        EXPECT_EQ(fault_of(file), file + ": cannot write: No space left on device");
        const SystemFault broken(call, EIO);
        EXPECT_EQ(fault_of(file), file + ": cannot write: Input/output error");
    }
    const auto expect_fault = [&](SystemCall call, int error, const std::string& fault) {
        const SystemFault failing(call, error);
        EXPECT_EQ(fault_of(file), file + ": " + fault);
    };
    expect_fault(SystemCall::open, ENOSPC, "cannot make a temporary beside it: No space left on device");
    expect_fault(SystemCall::open, EROFS, "cannot make a temporary beside it: Read-only file system");
    expect_fault(SystemCall::open, EEXIST, "cannot make a temporary beside it: File exists");
    expect_fault(SystemCall::duplicate, EMFILE, "cannot make a temporary beside it: Too many open files");
    expect_fault(SystemCall::set_mode, EPERM, "cannot set the mode: Operation not permitted");
    expect_fault(SystemCall::rename, EPERM, "cannot rename the temporary: Operation not permitted");
    EXPECT_EQ(load(file), "old");
    EXPECT_EQ(folder.names(), Names{"x"});
    EXPECT_EQ(fault_of(file), "none");
    EXPECT_EQ(load(file), "nnn");
}

TEST(AtomicFile, GoesOnAfterAnInterruptedCall) {
    const TemporaryFolder folder;
    int interruptions = 3;
    const SystemFault fault(SystemCall::write, [&] { return interruptions-- > 0 ? EINTR : 0; });
    EXPECT_EQ(fault_of(folder / "x"), "none");
    EXPECT_EQ(load(folder / "x"), "nnn");
}

TEST(AtomicFile, RefusesNamesThatAreTooLong) {
    const TemporaryFolder folder;
    const std::string name = (folder / std::string(256, 'x').c_str()).string();
    EXPECT_EQ(fault_of(name), name + ": cannot be written: File name too long");
    const std::string path = folder.path().string() + std::string(5000, '/') + "y";
    EXPECT_NE(fault_of(path).find("File name too long"), std::string::npos);
}

// What is open has no name that could be replaced, whatever it is.
TEST(AtomicFile, RefusesOpenFilesUnderTheirNumbers) {
    const TemporaryFolder folder;
    test::store(folder / "open", to_bytes("old"));
    const FileDescriptor open(::open((folder / "open").c_str(), O_RDWR | O_CLOEXEC));
    const std::string number = std::to_string(open.number());
    fs::create_symlink("/dev/stdout", folder / "out");
    fs::create_symlink("/dev/fd/" + number, folder / "link");
    const std::string names[] = {"/dev/stdout", "/dev/fd/" + number, "/proc/self/fd/" + number,
                                 (folder / "out").string(), (folder / "link").string()};
    for (const std::string& name : names) EXPECT_EQ(fault_of(name), name + ": not a regular file");
    EXPECT_EQ(load(folder / "open"), "old");
}

/// Ends the process with 0 where another's file is not replaced in a folder such as /tmp.
[[noreturn]] void try_sticky(const TemporaryFolder& folder) {
    constexpr uid_t nobody = 65534;
    if (::seteuid(nobody) != 0) ::_exit(1);
    const std::string path = folder.path().string();
    if (fault_of(folder / "root's") != path + "/root's: cannot be replaced: Operation not permitted") ::_exit(2);
    if (fault_of(folder / "new") != "none") ::_exit(3);
    if (fault_of(folder / "new") != "none") ::_exit(4);
    ::_exit(0);
}

TEST(AtomicFileDeathTest, RefusesAnothersFileInAStickyFolder) {
    if (::geteuid() != 0) GTEST_SKIP() << "takes two users, and so root";
    const TemporaryFolder folder;
    ASSERT_EQ(::chmod(folder.path().c_str(), 01777), 0);
    test::store(folder / "root's", to_bytes("old"));
    ASSERT_EQ(::chmod((folder / "root's").c_str(), 0666), 0);
    EXPECT_EXIT(try_sticky(folder), ::testing::ExitedWithCode(0), "");
    EXPECT_EQ(load(folder / "root's"), "old");
    EXPECT_EQ(folder.names(), (Names{"new", "root's"}));
}

/// In a name space of its own, so that what is mounted is gone with the process.
bool mount_here(const char* source, const fs::path& folder, const char* type, unsigned long flags, const char* data) {
    return ::unshare(CLONE_NEWNS) == 0 && ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           ::mount(source, folder.c_str(), type, flags, data) == 0;
}
constexpr int not_permitted = 99;

/// Ends the process with 0 where a full disk keeps the old file.
[[noreturn]] void try_small_disk(const TemporaryFolder& folder) {
    if (!mount_here("none", folder.path(), "tmpfs", 0, "size=64k")) ::_exit(not_permitted);
    write_atomically(folder / "x", to_bytes("old"));
    const std::string known = fault_of(folder / "x", 100'000);
    if (known.find("takes 100000 bytes, and the disk has room for") == known.npos) ::_exit(1);
    std::string met;
    try {
        AtomicFile file(folder / "x");
        for (int i = 0; i < 100; ++i) file.write(Bytes(1000));
        file.commit();
    } catch (const std::runtime_error& error) {
        met = error.what();
    }
    if (met != (folder / "x").string() + ": cannot write: No space left on device") ::_exit(2);
    if (load(folder / "x") != "old" || folder.names() != Names{"x"}) ::_exit(3);
    if (fault_of(folder / "x", 1000) != "none") ::_exit(4);
    ::_exit(0);
}

/// Ends the process with 0 where a file that is mounted is refused: nothing can take its name.
[[noreturn]] void try_mounted_file(const TemporaryFolder& folder) {
    if (!mount_here((folder / "a").c_str(), folder / "b", nullptr, MS_BIND, nullptr)) ::_exit(not_permitted);
    ::_exit(fault_of(folder / "b") == (folder / "b").string() + ": cannot be replaced: Device or resource busy" ? 0
                                                                                                                : 1);
}

/// Runs `attempt` in a process of its own; skips the test where that is not allowed what it needs.
template <class Attempt>
int exit_code_of(Attempt attempt) {
    const pid_t child = ::fork();
    if (child == 0) attempt();
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(AtomicFile, LeavesThePreviousFileOnAFullDisk) {
    const TemporaryFolder folder;
    const int code = exit_code_of([&] { try_small_disk(folder); });
    if (code == not_permitted) GTEST_SKIP() << "may not mount";
    EXPECT_EQ(code, 0);
}

TEST(AtomicFile, RefusesAFileThatIsMounted) {
    const TemporaryFolder folder;
    test::store(folder / "a", to_bytes("a"));
    test::store(folder / "b", to_bytes("b"));
    const int code = exit_code_of([&] { try_mounted_file(folder); });
    if (code == not_permitted) GTEST_SKIP() << "may not mount";
    EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace orrery
