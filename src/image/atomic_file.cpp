#include "image/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <stdexcept>

#include "image/temporaries.hpp"
#include "system/file_descriptor.hpp"
#include "system/links.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;

/// What the file system knows of a name; nothing where there is no such file. Sets `error` where it cannot tell.
std::optional<struct statx> look_up(const fs::path& file, int& error) {
    struct statx status = {};
    error = 0;
    if (::statx(AT_FDCWD, file.c_str(), 0, STATX_BASIC_STATS, &status) == 0) return status;
    if (errno != ENOENT) error = errno;
    return std::nullopt;
}

bool has(const struct statx& status, std::uint64_t attribute) { return (status.stx_attributes & attribute) != 0; }

/// Why a rename would not replace this file, 0 where it would.
int replacing_error(const fs::path& target, const struct statx& status, const struct statx& folder) {
    if (has(status, STATX_ATTR_MOUNT_ROOT)) return EBUSY;
    if (has(status, STATX_ATTR_IMMUTABLE) || has(status, STATX_ATTR_APPEND)) return EPERM;
    // A rename would replace a write-protected file without asking, which is not what its owner meant.
    if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) return errno;
    // In such a folder, /tmp say, nobody replaces what is another's.
    const uid_t we = ::geteuid();
    const bool sticky = (folder.stx_mode & S_ISVTX) != 0;
    return sticky && we != 0 && we != status.stx_uid && we != folder.stx_uid ? EPERM : 0;
}

/// Why no file can be made in this folder, 0 where one can.
int making_error(const fs::path& folder, const struct statx& status) {
    if (has(status, STATX_ATTR_IMMUTABLE) || has(status, STATX_ATTR_APPEND)) return EPERM;
    return ::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) == 0 ? 0 : errno;
}

void require_room(const fs::path& file, const fs::path& folder, std::uint64_t bytes) {
    rlimit limit = {};
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur < bytes)
        throw std::runtime_error(
            fmt::format("{}: takes {} bytes, and files may have {}", file.string(), bytes, limit.rlim_cur));
    struct statvfs system = {};
    // File systems of no blocks are not on a disk.
    if (::statvfs(folder.c_str(), &system) != 0 || system.f_blocks == 0) return;
    const std::uint64_t blocks = ::geteuid() == 0 ? system.f_bfree : system.f_bavail;
    if (blocks < (bytes + system.f_frsize - 1) / system.f_frsize)
        throw std::runtime_error(fmt::format("{}: takes {} bytes, and the disk has room for {}", file.string(), bytes,
                                             blocks * system.f_frsize));
}

/// The permission bits of the file to be replaced, nothing where there is none.
std::optional<mode_t> existing_mode(const fs::path& target) {
    struct stat status = {};
    if (::stat(target.c_str(), &status) != 0) return std::nullopt;
    return status.st_mode & mode_t{0777};
}

}  // namespace

fs::path writable_target(const fs::path& file, std::uint64_t bytes) {
    std::error_code link_error;
    const fs::path target = follow_links(file, link_error);
    if (link_error == std::errc::no_such_device_or_address)
        throw std::runtime_error(fmt::format("{}: not a regular file", file.string()));
    if (link_error) throw_system_error(file, "cannot follow the link", link_error.value());

    int error = 0;
    const fs::path folder = folder_of(target);
    const auto folder_status = look_up(folder, error);
    if (error != 0) throw_system_error(file, folder.string(), error);
    if (!folder_status)
        throw std::runtime_error(fmt::format("{}: the folder {} does not exist", file.string(), folder.string()));
    if (!S_ISDIR(folder_status->stx_mode)) throw_system_error(file, folder.string(), ENOTDIR);

    const auto status = look_up(target, error);
    if (error != 0) throw_system_error(file, "cannot be written", error);
    if (!target.has_filename() || (status && S_ISDIR(status->stx_mode)))
        throw std::runtime_error(fmt::format("{}: is a directory", file.string()));
    // A device or a pipe would be replaced by a file under its name.
    if (status && !S_ISREG(status->stx_mode))
        throw std::runtime_error(fmt::format("{}: not a regular file", file.string()));
    if (status) error = replacing_error(target, *status, *folder_status);
    if (error != 0) throw_system_error(file, "cannot be replaced", error);
    error = making_error(folder, *folder_status);
    if (error != 0) throw_system_error(file, fmt::format("cannot write to the folder {}", folder.string()), error);
    require_room(file, folder, bytes);
    return target;
}

/// A temporary file that is gone with its owner unless it was renamed.
class AtomicFile::Temporary {
public:
    explicit Temporary(const fs::path& path)
        : pending_(path.native()),
          path_(path),
          // Mode 0666 lets the kernel apply the umask; asking for the umask would change it for all threads.
          file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)),
          error_(file_.is_open() ? 0 : errno),
          exists_(file_.is_open()),
          lock_(exists_ ? ::fcntl(file_.number(), F_DUPFD_CLOEXEC, 0) : -1) {
        if (!exists_) return;
        if (!lock_.is_open()) {
            error_ = errno;
        } else if (!lock_temporary(file_.number())) {
            error_ = EEXIST;  // as if another had had that name
        }
    }
    ~Temporary() {
        if (exists_) ::unlink(path_.c_str());
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    int error() const { return error_; }  ///< why it could not be made, 0 where it was

    // Each returns 0 or the error.
    int write(std::span<const std::byte> bytes);
    int set_mode(mode_t mode) { return ::fchmod(file_.number(), mode) == 0 ? 0 : errno; }
    int flush();
    int rename_to(const fs::path& target);

private:
    PendingTemporary pending_;
    fs::path path_;
    FileDescriptor file_;
    int error_;
    bool exists_;
    FileDescriptor lock_;  ///< holds what lock_temporary took after file_ is closed, until all is done
};

int AtomicFile::Temporary::write(std::span<const std::byte> bytes) {
    constexpr std::size_t most_at_once = std::size_t{1} << 30;  // Linux writes at most 2 GiB per call
    while (!bytes.empty()) {
        const ssize_t count = ::write(file_.number(), bytes.data(), std::min(bytes.size(), most_at_once));
        if (count < 0 && errno != EINTR) return errno;
        if (count == 0) return EIO;  // no progress and no reason: better an error than a loop
        if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return 0;
}

int AtomicFile::Temporary::flush() {
    // Flushed before the rename: otherwise a crash could leave the new name with no content. EINVAL is a file system
    // that has nothing to flush.
    if (::fsync(file_.number()) != 0 && errno != EINVAL) return errno;
    return file_.close();
}

int AtomicFile::Temporary::rename_to(const fs::path& target) {
    if (::rename(path_.c_str(), target.c_str()) != 0) return errno;
    exists_ = false;
    return 0;
}

AtomicFile::AtomicFile(const fs::path& file, std::uint64_t bytes) : file_(file), target_(writable_target(file, bytes)) {
    const std::optional<mode_t> mode = existing_mode(target_);
    // Beside the target, since a rename does not cross file systems.
    const fs::path folder = folder_of(target_);
    remove_leftovers(folder);
    constexpr int attempts = 100;
    for (int i = 0; i < attempts; ++i) {
        temporary_.reset();  // before the next: each keeps one of few places
        temporary_ = std::make_unique<Temporary>(folder / temporary_name());
        if (temporary_->error() != EEXIST) break;
    }
    require("cannot make a temporary beside it", temporary_->error());
    if (mode) require("cannot set the mode", temporary_->set_mode(*mode));
}

AtomicFile::~AtomicFile() = default;

void AtomicFile::write(std::span<const std::byte> bytes) { require("cannot write", temporary_->write(bytes)); }

void AtomicFile::commit() {
    require("cannot write", temporary_->flush());
    require("cannot rename the temporary", temporary_->rename_to(target_));
}

void AtomicFile::require(const char* what, int error) const {
    if (error != 0) throw_system_error(file_, what, error);
}

void write_atomically(const fs::path& file, std::span<const std::byte> bytes) {
    AtomicFile whole(file, bytes.size());
    whole.write(bytes);
    whole.commit();
}

}  // namespace orrery
