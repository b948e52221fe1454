// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace orrery {

/// The file that writing to `file` would replace: symbolic links are followed, also those that lead to nothing yet.
/// Throws std::runtime_error where that cannot work, as far as the system can tell, with so many `bytes` or more: what
/// a long render wants to know before it starts. So where the folder is missing, not writable or without room; where
/// the name is too long; where the target is a directory, not a regular file (an open one of /proc, as /dev/stdout, is
/// none either), write-protected, mounted, or another's in a folder such as /tmp.
std::filesystem::path writable_target(const std::filesystem::path& file, std::uint64_t bytes = 0);

/// A file in the making, beside its target, for what is written piece by piece. Commit flushes it to the disk and
/// renames it; a failure at any step, a full disk included, or no commit at all leaves the previous file and no
/// temporary; one that a killed process left in the folder is removed. A new file's mode is what the umask allows, a
/// replaced one keeps its own.
/// All throw std::runtime_error with the path and the system's reason.
class AtomicFile {
public:
    /// At least so many bytes are to come. Without write and commit it shows that they could.
    explicit AtomicFile(const std::filesystem::path& file, std::uint64_t bytes = 0);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const std::byte> bytes);
    void commit();

private:
    class Temporary;
    void require(const char* what, int error) const;

    std::filesystem::path file_, target_;
    std::unique_ptr<Temporary> temporary_;
};

/// All of it at once.
void write_atomically(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace orrery
