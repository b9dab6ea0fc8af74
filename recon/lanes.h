// Numbers side by side, as a vector register of the processor has them.
#pragma once

#include <cstring>

namespace tessera {

/// Numbers that are worked on together: what a vector register of the processor holds.
#ifdef __AVX__
inline constexpr int lanes = 8;
#else
inline constexpr int lanes = 4;
#endif

/// `lanes` floats with the arithmetic of one: a vector type of GCC and Clang, which compiles for any processor.
using Lanes = float __attribute__((vector_size(lanes * sizeof(float))));

/// `lanes` values from `from` on, aligned as floats are.
inline Lanes load(const float* from) {
    Lanes value;
    std::memcpy(&value, from, sizeof(value));
    return value;
}

inline void store(float* to, const Lanes& value) {
    std::memcpy(to, &value, sizeof(value));
}

} // namespace tessera
