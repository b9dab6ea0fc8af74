#pragma once

#include <string>

namespace tessera {

/// CPU time of the whole process, user and system, in seconds (getrusage).
double process_cpu_seconds();

/// The largest resident memory so far, in bytes.
double peak_memory_bytes();

/// What the system calls its processor, such as "Intel(R) Xeon(R) CPU @ 2.20GHz"; "unknown" where it does not say.
std::string cpu_model();

/// The processor and what there is of it, "AMD EPYC, 2 hardware threads, 8 GB": memory in 10^9 bytes (left out
/// where the system does not say).
std::string machine_text();

/// The date in UTC, such as "2026-11-22".
std::string today();

/// The program's version and a checksum of its file, so that two builds are told apart: "0.1.0 5f3a0c11".
const std::string& program_identity();

} // namespace tessera
