#include "program.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace orrery::test {
namespace {

void limit(int resource, std::optional<rlim_t> most) {
    if (!most) return;
    const rlimit value = {*most, *most};
    ::setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

void redirect(int descriptor, const std::filesystem::path& file) {
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT, 0644);
    if (opened < 0) ::_exit(126);
    ::dup2(opened, descriptor);
    ::close(opened);
}

void set_variable(const char* name, const std::string& value) {
    if (value.empty()) {
        ::unsetenv(name);
    } else {
        ::setenv(name, value.c_str(), 1);
    }
}

/// In the child: becomes the program.
[[noreturn]] void become(const std::vector<std::string>& arguments, const Surroundings& surroundings,
                         const std::filesystem::path& output, const std::filesystem::path& error) {
    // Before it may become another user's, who need not see the folder it is in.
    const int program = ::open(ORRERY_PROGRAM, O_RDONLY | O_CLOEXEC);
    // Also where the test itself is killed, by ctest's time limit say.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::close(STDIN_FILENO);
    redirect(STDOUT_FILENO, surroundings.output.empty() ? output : surroundings.output);
    if (surroundings.terminal >= 0) {
        ::dup2(surroundings.terminal, STDERR_FILENO);
    } else {
        redirect(STDERR_FILENO, error);
    }
    if (surroundings.output_closed) ::close(STDOUT_FILENO);
    if (!surroundings.folder.empty() && ::chdir(surroundings.folder.c_str()) != 0) ::_exit(126);
    set_variable("COLUMNS", surroundings.columns);
    set_variable("ORRERY_COMMAND", surroundings.typed);
    limit(RLIMIT_FSIZE, surroundings.largest_file);
    limit(RLIMIT_AS, surroundings.address_space);
    if (surroundings.ignored_signal != 0) ::signal(surroundings.ignored_signal, SIG_IGN);
    if (surroundings.tasks) {
        constexpr uid_t nobody = 65534;  // root's tasks are not counted
        if (::geteuid() == 0 && ::setuid(nobody) != 0) ::_exit(126);
        limit(RLIMIT_NPROC, surroundings.tasks);
    }

    std::vector<char*> argv = {const_cast<char*>("orrery")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    ::fexecve(program, argv.data(), environ);
    ::_exit(127);
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, const Surroundings& surroundings) : process_(::fork()) {
    if (process_ < 0) throw std::runtime_error("cannot fork");
    if (process_ == 0) become(arguments, surroundings, streams_ / "output", streams_ / "error");
}

Program::~Program() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

void Program::send(int signal) const { ::kill(process_, signal); }

Outcome Program::wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0)
        if (errno != EINTR) throw std::runtime_error("cannot wait for the program");
    process_ = 0;
    const auto text = [&](const char* name) {
        return std::filesystem::exists(streams_ / name) ? load(streams_ / name) : std::string();
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text("output"), text("error")};
}

Outcome orrery(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
    return Program(arguments, surroundings).wait();
}

std::string scene_file(const std::string& name) { return std::string(ORRERY_SCENES_DIR) + "/" + name; }

std::size_t count_of(const std::string& part, const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
    return count;
}

}  // namespace orrery::test
