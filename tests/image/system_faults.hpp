// Failures of the operating system that no test can bring about in earnest everywhere: a disk that is full on write,
// on flush or only on close, a rename that fails, no descriptor left, a signal in the middle.
#pragma once

#include <functional>

namespace orrery::test {

enum class SystemCall { open, duplicate, lock, set_mode, write, fsync, close, rename };

/// While it lives, the given call does `instead` first; where that returns an error number the call fails with it
/// and does nothing else (close closes nonetheless, as the kernel does), and where it returns 0 the call goes on. Of
/// open only what makes a file is meant, of fcntl what duplicates a descriptor.
/// The linker puts us between: see --wrap in CMakeLists.txt. One at a time.
class SystemFault {
public:
    SystemFault(SystemCall call, std::function<int()> instead);
    SystemFault(SystemCall call, int error);
    ~SystemFault();
    SystemFault(const SystemFault&) = delete;
    SystemFault& operator=(const SystemFault&) = delete;
};

}  // namespace orrery::test
