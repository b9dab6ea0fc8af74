#include "app/reference.h"

#include "app/exit_codes.h"
#include "app/interrupt.h"
#include "app/load_notes.h"
#include "app/output_file.h"
#include "app/scene_source.h"
#include "render/load/image_files.h"
#include "render/method/settings_table.h"

#include <algorithm>

#include <fmt/core.h>

namespace tessera {

int run_reference(const ReferenceOptions& options) {
    check(options.recipe.settings);
    if (extension_of(options.output) != ".exr")
        throw BadInput(fmt::format("{}: the name must end in .exr", options.output.string()));
    check_writable(options.output);
    ThreadPool pool(options.threads);
    const OpenedScene opened = open_scene(options.scene, pool);
    for (const std::string& note : group_notes(opened.notes))
        fmt::print(stderr, "note: {}\n", note);
    ReferenceRecipe recipe = options.recipe;
    recipe.size = options.size.value_or(opened.scene->size());
    recipe.settings.max_depth = options.max_depth.value_or(std::min(opened.scene->max_depth(), most_edges));

    const InterruptGuard guard;
    const auto reference = render_reference(options.output, options.scene, opened.scene, recipe, pool);
    if (!reference) {
        fmt::print(stderr, "{}: not complete; the same command goes on from its checkpoint\n",
                   options.output.string());
        return exit_failure;
    }
    const FloorFreeError error = error_of(*reference);
    fmt::print("{}: relMSE of the reference itself {:.3g} +- {:.2g}\n", options.output.string(),
               error.relative_mse, error.standard_error);
    return exit_ok;
}

} // namespace tessera
