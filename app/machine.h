#pragma once

#include <string>

namespace tessera {

/// "Intel(R) Xeon(R) CPU @ 2.20GHz": what the system calls its processor; "unknown" where it does not say.
std::string cpu_model();

} // namespace tessera
