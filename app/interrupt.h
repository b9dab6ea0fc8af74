#pragma once

namespace tessera {

/// While one lives, Ctrl-C (SIGINT) or SIGTERM ask for an end in good order; a second one, of either
/// kind, ends the process.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Whether the latest guard has seen either.
bool interrupted();

} // namespace tessera
