#include "app/experiment/references.h"

#include "app/cli/opened_scene.h"
#include "app/cli/render_stats.h"
#include "app/cli/terminal.h"
#include "render/scene/scene.h"

#include <cstdint>
#include <cstdio>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

/// Renders a reference to its end and shows the progress. Returns false if Ctrl-C interrupted it.
bool complete(ReferenceRender& render, const std::filesystem::path& output, const SceneSource& source) {
    const int resumed = render.spp_resumed(), wanted = render.spp_wanted();
    if (resumed > 0)
        fmt::print(stderr, "{}: going on from {} spp\n", reference_checkpoint(output).string(), resumed);
    {
        Progress progress("reference");
        const auto tell = [&](const ReferenceRender& r) {
            if (r.spp() > resumed)
                progress.update(static_cast<double>(r.spp() - resumed) / (wanted - resumed), r.seconds(),
                                fmt::format("{} of {} spp", r.spp(), wanted));
            return !interrupted();
        };
        if (!render.run(tell))
            return false;
        tell(render);
    }
    for (const Render& half : render.halves())
        warn_of_invalid_samples(source, half);
    return true;
}

} // namespace

std::optional<ReferenceImage> render_reference(const std::filesystem::path& output, const SceneSource& source,
                                               const std::shared_ptr<const Scene>& scene,
                                               const ReferenceRecipe& recipe, ThreadPool& pool) {
    ReferenceRender render(output, {source, scene, scene->camera()}, recipe, pool);
    if (!complete(render, output, source))
        return {};
    return render.finish();
}

bool render_shard(const std::filesystem::path& output, const SceneSource& source,
                  const std::shared_ptr<const Scene>& scene, const ReferenceRecipe& recipe, ThreadPool& pool) {
    ReferenceRender render(output, {source, scene, scene->camera()}, recipe, pool);
    if (!complete(render, output, source))
        return false;
    render.finish_shard();
    return true;
}

FolderReference::FolderReference(const std::filesystem::path& folder, const std::string& scene_name,
                                 ReferenceRecipe recipe)
    : path_(reference_file(folder, scene_name, recipe.size, recipe.settings.max_depth, recipe.settings.filter)),
      recipe_(std::move(recipe)) {
    look();
}

bool FolderReference::look() {
    if (is_complete() || !std::filesystem::exists(path_))
        return is_complete();
    image_ = read_reference(path_);
    checksum_ = checksum_of(*image_);
    const glm::ivec2 size(image_->mean.width(), image_->mean.height());
    if (size != recipe_.size)
        throw BadInput(fmt::format("{} is {}x{}, but {}x{} is to be rendered", path_.string(), size.x, size.y,
                                   recipe_.size.x, recipe_.size.y));
    return true;
}

void FolderReference::check_writable() const {
    if (is_complete())
        return;
    make_folder(path_.parent_path());
    tessera::check_writable(path_);
}

std::array<std::uint64_t, 2> FolderReference::seeds() const {
    const std::uint64_t first = recipe_.settings.seed;
    return is_complete() ? image_->seeds : std::array{first, first + 1};
}

bool FolderReference::render(const SceneSource& source, const std::shared_ptr<const Scene>& scene,
                             ThreadPool& pool) {
    fmt::print(stderr, "{} is missing: rendering it\n", path_.string());
    image_ = render_reference(path_, source, scene, recipe_, pool);
    if (is_complete())
        checksum_ = checksum_of(*image_);
    return is_complete();
}

void FolderReference::check_scene(const SceneSource& source, const Scene& scene) const {
    if (!is_complete())
        return;
    if (!image_->scene)
        return fmt::print(stderr, "note: {} does not say which scene it is of: that cannot be checked\n",
                          path_.string());
    std::string difference =
        tessera::difference(*image_->scene, checksums_of(scene.description(), scene.camera()));
    // Checksums leave the sensor's filter out, because most renders do not use it.
    if (difference.empty() && recipe_.settings.filter == FilterKind::scene && !image_->camera.empty() &&
        parse_camera(image_->camera, path_.string()).filter != scene.camera().filter)
        difference = "reconstruction filter";
    if (!difference.empty())
        throw BadInput(
            fmt::format("{} does not match {}: different {}. Delete the file to render it again, or choose "
                        "another folder with --reference",
                        path_.string(), to_string(source), difference));
}

} // namespace tessera
