// The operating system's files, with its reasons as exceptions.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <utility>

namespace orrery {

/// std::runtime_error "FILE: WHAT: reason", the reason being that of `error`.
[[noreturn]] void throw_system_error(const std::filesystem::path& file, std::string_view what, int error);

/// An open file that is closed with its owner.
class FileDescriptor {
public:
    explicit FileDescriptor(int number) : number_(number) {}
    ~FileDescriptor() {
        if (is_open()) ::close(number_);
    }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;

    bool is_open() const { return number_ >= 0; }
    int number() const { return number_; }

    /// Closes now, for who wants to know whether that went well: some file systems report a full disk only here.
    /// Returns 0 or the error. Never repeated, not after EINTR either: the number may belong to another file by then.
    int close() { return ::close(std::exchange(number_, -1)) == 0 || errno == EINTR ? 0 : errno; }

private:
    int number_;
};

}  // namespace orrery
