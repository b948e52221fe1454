#include "cli/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>

#include "image/temporaries.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

/// Returns 0 or the error.
int write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor, text.data(), text.size());
        if (count < 0 && errno != EINTR) return errno;
        if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

std::atomic<bool> deferred = false, waiting = false;
std::atomic<int> caught_signal = 0;
std::atomic<const char*> loss = nullptr;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);

[[noreturn]] void end_by(int signal) {
    remove_pending_temporaries();
    // Whoever shows a progress bar will not take it back any more.
    constexpr char erase_line[] = "\r\x1B[K";
    if (::isatty(STDERR_FILENO) != 0) static_cast<void>(!::write(STDERR_FILENO, erase_line, sizeof erase_line - 1));
    Loss::say();
    ::_exit(exit_code::ended_by(signal));
}

// On Linux setitimer is a system call and nothing else, so that a handler may use it.
void ring_in(suseconds_t microseconds) {
    const itimerval once = {.it_interval = {0, 0}, .it_value = {0, microseconds}};
    ::setitimer(ITIMER_REAL, &once, nullptr);
}

extern "C" void on_stop_signal(int signal) {
    const int interrupted_error = errno;
    int none = 0;
    if (!deferred || !caught_signal.compare_exchange_strong(none, signal)) end_by(signal);
    if (!waiting) ring_in(60'000);
    errno = interrupted_error;
}

extern "C" void on_alarm(int alarm) {
    // Or somebody else's, who means what an alarm means where nobody handles it.
    const int caught = caught_signal;
    end_by(caught != 0 ? caught : alarm);
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
}

}  // namespace

std::string_view version() { return ORRERY_VERSION; }

void occupy_standard_descriptors() {
    // Read-only, so that what is written there still fails; open takes the lowest free number.
    for (int descriptor = 0; descriptor <= 2; ++descriptor)
        if (::fcntl(descriptor, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDONLY));
}

void print_result(std::string_view text) {
    if (const int error = write_all(STDOUT_FILENO, text); error != 0)
        throw std::runtime_error(fmt::format("cannot write to standard output: {}", std::strerror(error)));
}

void print_name(const std::filesystem::path& file) {
    const std::string name = file.string();
    print_result((::isatty(STDOUT_FILENO) != 0 ? printable_whole(name) : name) + "\n");
}

void print_error(std::string_view message) { print_line(fmt::format("orrery: error: {}", message)); }

void print_warning(std::string_view message) { print_line(fmt::format("orrery: warning: {}", message)); }

void print_line(std::string_view text) { print_message(printable_whole(text) + "\n"); }

void print_message(std::string_view text) { write_all(STDERR_FILENO, text); }

void install_signal_handlers() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    handle(SIGALRM, on_alarm);
    // It may come blocked, too, from whoever started us.
    sigset_t alarm;
    sigemptyset(&alarm);
    sigaddset(&alarm, SIGALRM);
    ::sigprocmask(SIG_UNBLOCK, &alarm, nullptr);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction inherited = {};
        ::sigaction(signal, nullptr, &inherited);
        // nohup asks that the render outlive its terminal, and so does a script's `trap '' INT`.
        if (inherited.sa_handler != SIG_IGN) handle(signal, on_stop_signal);
    }
}

Loss::Loss(const char* text) { loss = text; }

Loss::~Loss() { loss = nullptr; }

void Loss::say() {
    if (const char* const text = loss.exchange(nullptr))
        static_cast<void>(!::write(STDERR_FILENO, text, std::strlen(text)));
}

DeferredSignals::DeferredSignals(bool wait) {
    waiting = wait;
    deferred = true;
}

DeferredSignals::~DeferredSignals() { deferred = false; }

int DeferredSignals::caught() const { return caught_signal; }

}  // namespace orrery
