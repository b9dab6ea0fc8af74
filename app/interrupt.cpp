#include "app/interrupt.h"

#include <atomic>
#include <csignal>

namespace tessera {

namespace {

std::atomic<bool> seen = false;

void reset() {
    for (int signal : {SIGINT, SIGTERM})
        std::signal(signal, SIG_DFL);
}

} // namespace

InterruptGuard::InterruptGuard() {
    seen = false;
    for (int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int) {
            seen = true;
            reset(); // of either kind, the second one ends the process
        });
}

InterruptGuard::~InterruptGuard() {
    reset();
}

bool interrupted() {
    return seen;
}

} // namespace tessera
