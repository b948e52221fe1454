#include "system_faults.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <optional>

namespace orrery::test {
namespace {

std::optional<SystemCall> faulty;
std::function<int()> action;

/// Whether the call is to fail; errno says why.
bool fails(SystemCall call) {
    if (faulty != call) return false;
    const int error = action();
    if (error != 0) errno = error;
    return error != 0;
}

}  // namespace

SystemFault::SystemFault(SystemCall call, std::function<int()> instead) {
    action = std::move(instead);
    faulty = call;
}

SystemFault::SystemFault(SystemCall call, int error) : SystemFault(call, [error] { return error; }) {}

SystemFault::~SystemFault() { faulty.reset(); }

}  // namespace orrery::test

// The names are the linker's.
extern "C" {

int __real_open(const char* path, int flags, ...);
int __real_fcntl(int file, int command, ...);
int __real_flock(int file, int operation);
int __real_fchmod(int file, mode_t mode);
ssize_t __real_write(int file, const void* bytes, size_t count);
int __real_fsync(int file);
int __real_close(int file);
int __real_rename(const char* from, const char* to);

int __wrap_open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : mode_t{0};
    va_end(rest);
    if ((flags & O_CREAT) != 0 && orrery::test::fails(orrery::test::SystemCall::open)) return -1;
    return __real_open(path, flags, mode);
}

int __wrap_fcntl(int file, int command, ...) {
    va_list rest;
    va_start(rest, command);
    const long argument = va_arg(rest, long);
    va_end(rest);
    if (command == F_DUPFD_CLOEXEC && orrery::test::fails(orrery::test::SystemCall::duplicate)) return -1;
    return __real_fcntl(file, command, argument);
}

int __wrap_flock(int file, int operation) {
    return orrery::test::fails(orrery::test::SystemCall::lock) ? -1 : __real_flock(file, operation);
}

int __wrap_fchmod(int file, mode_t mode) {
    return orrery::test::fails(orrery::test::SystemCall::set_mode) ? -1 : __real_fchmod(file, mode);
}

ssize_t __wrap_write(int file, const void* bytes, size_t count) {
    return orrery::test::fails(orrery::test::SystemCall::write) ? -1 : __real_write(file, bytes, count);
}

int __wrap_fsync(int file) { return orrery::test::fails(orrery::test::SystemCall::fsync) ? -1 : __real_fsync(file); }

int __wrap_close(int file) {
    if (!orrery::test::fails(orrery::test::SystemCall::close)) return __real_close(file);
    const int error = errno;
    __real_close(file);
    errno = error;
    return -1;
}

int __wrap_rename(const char* from, const char* to) {
    return orrery::test::fails(orrery::test::SystemCall::rename) ? -1 : __real_rename(from, to);
}

}  // extern "C"
