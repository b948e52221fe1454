#include "image/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <optional>
#include <stdexcept>

#include "image/file_descriptor.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;

fs::path followed(const fs::path& file) {
    constexpr int longest_chain = 40;  // as the kernel allows
    fs::path target = file;
    for (int links = 0; links < longest_chain; ++links) {
        std::error_code error;
        if (!fs::is_symlink(fs::symlink_status(target, error))) return target;
        const fs::path next = fs::read_symlink(target, error);
        if (error) throw_system_error(file, "cannot follow the link", error.value());
        target = target.parent_path() / next;  // an absolute `next` replaces all
    }
    throw_system_error(file, "cannot follow the link", ELOOP);
}

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

/// The permission bits of the file to be replaced, nothing where there is none.
std::optional<mode_t> existing_mode(const fs::path& target) {
    struct stat status = {};
    if (::stat(target.c_str(), &status) != 0) return std::nullopt;
    return status.st_mode & mode_t{0777};
}

}  // namespace

fs::path writable_target(const fs::path& file) {
    const fs::path target = followed(file);
    const fs::path folder = folder_of(target);
    std::error_code error;
    const fs::file_status folder_status = fs::status(folder, error);
    if (folder_status.type() == fs::file_type::not_found)
        throw std::runtime_error(fmt::format("{}: the folder {} does not exist", file.string(), folder.string()));
    if (error) throw_system_error(file, folder.string(), error.value());
    if (!fs::is_directory(folder_status)) throw_system_error(file, folder.string(), ENOTDIR);

    const fs::file_status status = fs::status(target, error);
    if (!target.has_filename() || fs::is_directory(status))
        throw std::runtime_error(fmt::format("{}: is a directory", file.string()));
    // A device or a pipe would be replaced by a file under its name.
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw std::runtime_error(fmt::format("{}: not a regular file", file.string()));
    // A rename would replace a write-protected file without asking, which is not what its owner meant.
    if (fs::exists(status) && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0)
        throw_system_error(file, "cannot be replaced", errno);
    if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
        throw_system_error(file, fmt::format("cannot write to the folder {}", folder.string()), errno);
    return target;
}

/// A temporary file that is gone with its owner unless it was renamed.
class AtomicFile::Temporary {
public:
    /// Beside the target, since a rename does not cross file systems. The name is short and does not repeat the
    /// target's: that one may be as long as the file system allows.
    static fs::path next_name(const fs::path& folder) {
        static std::atomic<unsigned> count = 0;
        return folder / fmt::format(".orrery-{}-{}.tmp", ::getpid(), count++);
    }

    explicit Temporary(const fs::path& path)
        : pending_(path.native()),
          path_(path),
          // Mode 0666 lets the kernel apply the umask; asking for the umask would change it for all threads.
          file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)),
          error_(file_.is_open() ? 0 : errno),
          exists_(file_.is_open()) {}
    ~Temporary() {
        if (exists_) ::unlink(path_.c_str());
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    int error() const { return error_; }  ///< why it could not be made, 0 where it was

    // Each returns 0 or the error.
    int write(ByteView bytes);
    int set_mode(mode_t mode) { return ::fchmod(file_.number(), mode) == 0 ? 0 : errno; }
    int flush();
    int rename_to(const fs::path& target);

private:
    PendingTemporary pending_;
    fs::path path_;
    FileDescriptor file_;
    int error_;
    bool exists_;
};

int AtomicFile::Temporary::write(ByteView bytes) {
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

AtomicFile::AtomicFile(const fs::path& file) : file_(file), target_(writable_target(file)) {
    const std::optional<mode_t> mode = existing_mode(target_);
    // A name is taken only where an earlier process of this number left it behind, killed without a word.
    constexpr int attempts = 100;
    for (int i = 0; i < attempts; ++i) {
        temporary_.reset();  // before the next: each keeps one of few places
        temporary_ = std::make_unique<Temporary>(Temporary::next_name(folder_of(target_)));
        if (temporary_->error() != EEXIST) break;
    }
    require("cannot make a temporary beside it", temporary_->error());
    if (mode) require("cannot set the mode", temporary_->set_mode(*mode));
}

AtomicFile::~AtomicFile() = default;

void AtomicFile::write(ByteView bytes) { require("cannot write", temporary_->write(bytes)); }

void AtomicFile::commit() {
    require("cannot write", temporary_->flush());
    require("cannot rename the temporary", temporary_->rename_to(target_));
}

void AtomicFile::require(const char* what, int error) const {
    if (error != 0) throw_system_error(file_, what, error);
}

void write_atomically(const fs::path& file, ByteView bytes) {
    AtomicFile whole(file);
    whole.write(bytes);
    whole.commit();
}

}  // namespace orrery
