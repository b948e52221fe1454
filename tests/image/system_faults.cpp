#include "system_faults.hpp"

#include <unistd.h>

#include <cerrno>
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

ssize_t __real_write(int file, const void* bytes, size_t count);
int __real_fsync(int file);
int __real_close(int file);
int __real_rename(const char* from, const char* to);

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
