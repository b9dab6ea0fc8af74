#include "render/estimator/worker.h"

#include <algorithm>

namespace tessera {

std::uint64_t Worker::bytes(const RenderSettings& settings) {
    constexpr int long_path = 16; // vertices; vectors hold 2^n of them, and some paths of a block are that long
    const auto edge = static_cast<std::uint64_t>(block_edge_of(settings) + 1); // with the border
    const std::uint64_t paths = settings.method == Method::pt ? 1 : edge * edge;
    const auto vertices = static_cast<std::uint64_t>(std::min(settings.max_depth, long_path));
    constexpr std::uint64_t a_vertex = sizeof(BaseVertex) + sizeof(LightSample);
    const std::size_t means = (measures_reuse_gain(settings) ? sizeof(MeanOfPaths) : 0) +
                              (settings.method != Method::pt ? SetMeans::bytes(component_count(settings)) : 0);
    const std::uint64_t a_first_vertex = has_positions(settings) ? sizeof(BasePath) + a_vertex : 0;
    return sizeof(Worker) + paths * (sizeof(BasePath) + means + vertices * a_vertex + a_first_vertex);
}

} // namespace tessera
