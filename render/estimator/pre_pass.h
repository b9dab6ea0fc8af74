#pragma once

#include "recon/image.h"
#include "render/estimator/pass.h"
#include "render/estimator/worker.h"
#include "render/film/film.h"
#include "render/film/pixel_features.h"

namespace tessera {

// The pre-pass measures, before the first pass, what all passes of a render use: which pixels are mixed, where
// directly visible emitters have edges, and the projections of a basis with components. These samples are not
// part of the picture.

/// Takes the first feature samples of each pixel of a block.
void take_feature_samples(const Pass& pass, PixelRect block, Worker& worker, PixelFeatures& features);

/// Returns how many views find the edges of directly visible emitters: 4, because an emitter can be narrower than
/// a pixel, and surfaces in front of it are hit by some rays only. With a lens 16, one for each part of the lens:
/// some points of it see a blurred emitter and others do not. 0 if the settings do not treat these edges.
int very_direct_views(const Pass& pass);

/// Renders directly visible emission along one ray per pixel, for the pixels of a block and the image's border
/// beside it. The ray passes through one of 16 cells of the pixel and of the lens. Adjacent pixels use different
/// cells, so they differ where an emitter is blurred, too.
/// @param view     index of the view; each has another permutation of the cells
/// @param picture  image with one more pixel on all four sides
void show_very_direct(const Pass& pass, int view, PixelRect block, const Tracer& tracer, RgbImage& picture);

/// Number of points of a pixel from which its projections are computed.
inline constexpr int projection_points = 4;

/// Computes the projections s of theory (30) of the pixels of a block.
void find_projections(const Pass& pass, PixelRect block, const Tracer& tracer, Film& film);

} // namespace tessera
