#include "cli/signals.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "cli/exit_code.hpp"
#include "image/pending_temporaries.hpp"

namespace orrery {
namespace {

std::atomic<bool> deferred = false;
std::atomic<int> caught_signal = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void on_stop_signal(int signal) {
    int none = 0;
    if (deferred && caught_signal.compare_exchange_strong(none, signal)) return;
    remove_pending_temporaries();
    ::_exit(exit_code::ended_by(signal));
}

}  // namespace

void install_signal_handlers() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);

    struct sigaction action = {};
    action.sa_handler = on_stop_signal;
    action.sa_flags = SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction inherited = {};
        ::sigaction(signal, nullptr, &inherited);
        // nohup asks that the render outlive its terminal.
        if (signal == SIGHUP && inherited.sa_handler == SIG_IGN) continue;
        ::sigaction(signal, &action, nullptr);
    }
}

DeferredSignals::DeferredSignals() { deferred = true; }

DeferredSignals::~DeferredSignals() { deferred = false; }

int DeferredSignals::caught() const { return caught_signal; }

}  // namespace orrery
