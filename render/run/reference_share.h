// Shards of a reference: files with the sums of some of its passes, which merge_shards() adds up.
#pragma once

#include "render/run/picture_identity.h"
#include "render/run/reference_image.h"
#include "render/run/reference_render.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

/// Returns everything that determines the bits of a shard, as JSON: picture_identity(), and the shard's number and
/// the samples per pixel unless it is the whole reference.
std::string shard_identity(const PictureSubject& subject, const ReferenceRecipe& recipe);

/// Returns the identity of a shard's file, as JSON: everything that merge_shards() needs without loading the
/// scene.
std::string shard_header(const PictureSubject& subject, const ReferenceRecipe& recipe);

/// Adds the shards of a reference, and writes the reference to `output`. The bits depend on the number of shards,
/// and not on the order of `files` or the machines. Holds two shards in memory at a time. Throws
/// std::runtime_error that names the file if it is no shard or is damaged, or if it differs from the first one in
/// scene, camera, settings, version or number of shards; and one that lists missing or repeated shards.
ReferenceImage merge_shards(const std::vector<std::filesystem::path>& files, const std::filesystem::path& output);

} // namespace tessera
