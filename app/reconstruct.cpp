#include "app/reconstruct.h"

#include "app/exit_codes.h"
#include "app/gradient_input.h"
#include "app/output_file.h"
#include "app/process_usage.h"
#include "app/stats.h"
#include "render/load/json_text.h"

#include <chrono>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

using nlohmann::json;

/// Everything that decides the picture, beside what the input's own header says.
json reconstruction_json(const ReconstructOptions& options, const GradientInput& input) {
    json files = json::array(), norms = json::array();
    for (const std::filesystem::path& file : options.inputs)
        files.push_back(file.string());
    for (Norm norm : options.layers.norms)
        norms.push_back(to_string(norm));
    return {{"version", TESSERA_VERSION},
            {"inputs", files},
            {"width", input.images.primal.width()},
            {"height", input.images.primal.height()},
            {"norms", norms},
            {"alpha", options.layers.alpha},
            {"per_channel", options.layers.per_channel},
            {"repaired_pixels", input.repaired}};
}

void check_finite(const ExrFile& file) {
    for (const ExrLayer& layer : file.layers)
        if (const std::string bad = text_of_bad_pixel(layer.image); !bad.empty())
            throw BadInput(fmt::format("the values are too large to reconstruct from: {}", bad));
}

} // namespace

int run_reconstruct(const ReconstructOptions& options) {
    check_picture_name(options.output, options.layers);
    check_writable(options.output);
    if (!options.stats.empty())
        check_writable(options.stats);

    const auto start = std::chrono::steady_clock::now();
    const double start_cpu = process_cpu_seconds();
    GradientInput input = read_gradients(options.inputs, options.repair);
    const double load_cpu = process_cpu_seconds() - start_cpu;
    const double load_wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (input.repaired > 0)
        fmt::print(stderr, "warning: values that were not finite, or no variances, repaired: {}\n",
                   input.repaired);

    const json settings = reconstruction_json(options, input);
    ThreadPool pool(options.threads);
    std::vector<ReconstructionStats> recon;
    ExrFile file = reconstruct_layers(std::move(input.images), options.layers, pool, recon);
    check_finite(file);
    file.attributes = std::move(input.attributes);
    file.attributes["tessera:reconstruction"] = to_text(settings);
    write_picture(options.output, file);
    if (!options.stats.empty()) {
        const json stats{
            {"settings", settings},
            {"threads", pool.size()},
            {"seconds",
             {{"load", {{"wall", load_wall}, {"cpu", load_cpu}}}, {"reconstruct", reconstructions_json(recon)}}},
            {"peak_memory", peak_memory_bytes()}};
        write_text(options.stats, to_text(stats, 2) + "\n");
    }
    for (const ReconstructionStats& r : recon)
        fmt::print(stderr, "{}: {} in {:.3f} s ({:.3f} CPU s)\n", options.output.string(), to_string(r.norm),
                   r.seconds, r.cpu_seconds);
    return exit_ok;
}

} // namespace tessera
