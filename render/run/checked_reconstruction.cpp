#include "render/run/checked_reconstruction.h"

#include "render/io/available_memory.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include <fmt/core.h>

namespace tessera {

Reconstruction reconstruct_checked(Reconstructor& reconstructor, const GradientImages& images,
                                   const ReconstructionSettings& settings, const ParallelFor& parallel_for,
                                   int threads, const SolveWatch& watch) {
    const int width = images.primal.width(), height = images.primal.height();
    const Norm norm = applied(settings.norm, images.has_gradients());
    const std::string what = fmt::format("{}x{} pixels reconstructed by {}", width, height, to_string(norm));
    const ReconstructionSize size{width,
                                  height,
                                  images.has_gradients(),
                                  !images.demodulation.empty(),
                                  static_cast<int>(images.components.size()),
                                  threads};
    const std::uint64_t all = reconstructor.bytes_for(size, norm);
    const auto beside_kept = [&](std::uint64_t bytes) {
        return bytes - std::min(bytes, reconstructor.bytes_kept());
    };
    // Twice the need, because other parts of the program may need memory, too.
    reconstructor.set_keeps(has_free_memory(2 * beside_kept(all + Reconstructor::bytes_to_keep(width, height))));
    require_memory(beside_kept(all), what);
    return with_memory_for(what, [&] { return reconstructor.reconstruct(images, settings, parallel_for, watch); });
}

} // namespace tessera
