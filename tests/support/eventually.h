#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace tessera::test {

/// Waits until `condition` holds, and returns whether it did within two minutes. The limit is long because other
/// programs may use the machine.
inline bool eventually(const std::function<bool()>& condition) {
    using namespace std::chrono;
    for (const auto end = steady_clock::now() + minutes(2); steady_clock::now() < end;) {
        if (condition())
            return true;
        std::this_thread::sleep_for(milliseconds(5));
    }
    return false;
}

} // namespace tessera::test
