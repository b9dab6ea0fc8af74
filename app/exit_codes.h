#pragma once

#include <stdexcept>

namespace tessera {

/// What the process returns.
enum ExitCode : int { exit_ok = 0, exit_failure = 1, exit_bad_input = 2 };

/// Something that the user gave cannot be used: reported in one message, exit code 2.
class BadInput : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace tessera
