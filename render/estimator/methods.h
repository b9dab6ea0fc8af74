#pragma once

#include "recon/image.h"
#include "render/estimator/pass.h"
#include "render/estimator/worker.h"
#include "render/film/film.h"

namespace tessera {

/// Renders the pixels of one block of blocks_of() into the film with the pass's method. Clips tiles at the
/// image's border only.
void render_block(const Pass& pass, PixelRect block, Worker& worker, Film& film);

/// Returns, for a pass of PR or G-PR, the size of each pixel's reuse set; 1: the pixel reuses no paths.
Image<float> reuse_set_sizes(const Pass& pass);

} // namespace tessera
