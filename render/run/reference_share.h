// Shares of a reference: files of what some of its passes have summed, which are added up to the whole.
#pragma once

#include "render/run/picture_identity.h"
#include "render/run/reference_image.h"
#include "render/run/reference_render.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

/// What decides the bits of a share, as JSON: picture_identity, and, where it is not all, which share it is of how
/// many samples.
std::string share_identity(const PictureSubject& subject, const ReferenceRecipe& recipe);

/// The identity of a share's file, as JSON: all that merging it with others takes, the scene not loaded.
std::string share_header(const PictureSubject& subject, const ReferenceRecipe& recipe);

/// Adds the shares of a reference up, one after the other from the first to the last, in whatever order they are
/// given and wherever they were rendered: to the same bits for the same number of shares. Holds two of them in
/// memory at a time. Writes the reference to `output`. Throws std::runtime_error that names the file for one that
/// is no share, or damaged, or that is of another scene, camera, version, of other settings, or of another number
/// of shares than the first; and that says which shares are missing or there twice.
ReferenceImage merge_shares(const std::vector<std::filesystem::path>& files, const std::filesystem::path& output);

} // namespace tessera
