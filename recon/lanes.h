// Vector registers of floats: arithmetic, load, store and transposition.
#pragma once

#include <cstring>

namespace tessera {

/// Number of floats in a vector register.
#ifdef __AVX__
inline constexpr int lanes = 8;
#else
inline constexpr int lanes = 4;
#endif

/// `lanes` floats with elementwise arithmetic: a vector type of GCC and Clang, which compiles for any processor.
using Lanes = float __attribute__((vector_size(lanes * sizeof(float))));

/// Loads `lanes` floats without alignment.
inline Lanes load(const float* from) {
    Lanes value;
    std::memcpy(&value, from, sizeof(value));
    return value;
}

inline void store(float* to, const Lanes& value) {
    std::memcpy(to, &value, sizeof(value));
}

/// Transposes rows[l][j] into rows[j][l].
#ifdef __AVX__
inline void transpose(Lanes (&rows)[lanes]) {
    Lanes pairs[lanes];
    for (int i = 0; i < lanes; i += 2) {
        pairs[i] = __builtin_shufflevector(rows[i], rows[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
        pairs[i + 1] = __builtin_shufflevector(rows[i], rows[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
    }
    Lanes quads[lanes];
    for (int i = 0; i < lanes; i += 4) {
        for (int j = 0; j < 2; ++j) {
            const Lanes &a = pairs[i + j], &b = pairs[i + j + 2];
            quads[i + 2 * j] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
            quads[i + 2 * j + 1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
        }
    }
    for (int i = 0; i < 4; ++i) {
        rows[i] = __builtin_shufflevector(quads[i], quads[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        rows[i + 4] = __builtin_shufflevector(quads[i], quads[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
}
#else
inline void transpose(Lanes (&rows)[lanes]) {
    const Lanes low01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
    const Lanes low23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
    const Lanes high01 = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
    const Lanes high23 = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
    rows[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    rows[1] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    rows[2] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    rows[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}
#endif

} // namespace tessera
