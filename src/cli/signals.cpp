#include "cli/signals.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "cli/exit_code.hpp"
#include "image/pending_temporaries.hpp"

namespace orrery {
namespace {

std::atomic<bool> deferred = false;
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
    ring_in(60'000);
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

DeferredSignals::DeferredSignals() { deferred = true; }

DeferredSignals::~DeferredSignals() { deferred = false; }

int DeferredSignals::caught() const { return caught_signal; }

}  // namespace orrery
