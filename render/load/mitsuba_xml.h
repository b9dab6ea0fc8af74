#pragma once

#include "recon/parallel.h"
#include "render/io/text.h"
#include "render/load/scene_source.h"
#include "render/mesh/mesh_file.h"
#include "render/scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// A mesh file of a scene, and what its reader found.
struct MeshListing {
    FilePosition where; ///< of the file name in the scene
    std::string file;   ///< as in the scene
    FileReport report;
};

struct LoadedScene {
    SceneDescription description;
    std::vector<LoadNote> notes;     ///< in file order; everything ignored or replaced has a note
    std::vector<MeshListing> meshes; ///< of mesh files, in the order of the scene
    double parse_seconds = 0;        ///< wall time for the XML
    double file_seconds = 0;         ///< wall time for meshes and textures
};

/// Reads a Mitsuba scene (0.6 or 3.x syntax) with its includes, meshes and textures. FileSearch says where
/// files are searched. `progress` may be null. Damage that concerns one mesh, texture or transform is replaced,
/// with an error note: a mesh by an empty shape, a texture by grey, a step of a transform by nothing. With
/// `strict`, the first error note is thrown as LoadError. Throws LoadError with file, line and column, and
/// std::runtime_error after `progress->give_up()`.
LoadedScene load_mitsuba_xml(const std::filesystem::path& file, const SceneVariables& variables = {},
                             const ParallelFor& parallel_for = serial_for, LoadProgress* progress = nullptr,
                             bool strict = false);

/// Reads a scene from memory. Such a scene cannot refer to files. `name` replaces the file name in messages.
LoadedScene parse_mitsuba_xml(std::string_view xml, const std::string& name, const SceneVariables& variables = {},
                              const ParallelFor& parallel_for = serial_for, LoadProgress* progress = nullptr,
                              bool strict = false);

} // namespace tessera
