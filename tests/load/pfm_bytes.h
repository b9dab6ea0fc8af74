#pragma once

#include "recon/image.h"

#include <bit>
#include <cstdint>
#include <string>

namespace tessera {

/// Returns the contents of a PFM file with 3 channels, or with the red channel alone as grey.
inline std::string pfm_bytes(const RgbImage& image, int channels = 3, bool is_little_endian = true) {
    std::string bytes = (channels == 3 ? "PF\n" : "Pf\n") + std::to_string(image.width()) + " " +
                        std::to_string(image.height()) + (is_little_endian ? "\n-1.0\n" : "\n1.0\n");
    for (int y = image.height() - 1; y >= 0; --y)
        for (int x = 0; x < image.width(); ++x)
            for (int channel = 0; channel < channels; ++channel) {
                const auto bits = std::bit_cast<std::uint32_t>(image(x, y)[channel]);
                for (int i = 0; i < 4; ++i)
                    bytes += static_cast<char>(bits >> 8 * (is_little_endian ? i : 3 - i) & 255);
            }
    return bytes;
}

} // namespace tessera
