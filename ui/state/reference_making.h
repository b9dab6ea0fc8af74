#pragma once

#include "recon/metrics/metrics.h"
#include "render/settings/settings.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace tessera {

struct Document;

/// How far a reference is.
struct ReferenceProgress {
    std::filesystem::path file;
    int spp = 0, spp_wanted = 0;         ///< of both halves
    int spp_resumed = 0;                 ///< those that a checkpoint had
    double seconds_left = 0;             ///< infinite: not known yet
    std::optional<FloorFreeError> error; ///< of the mean of its halves so far
    bool is_ending = false;              ///< it was cancelled, and writes its checkpoint

    double share() const { return static_cast<double>(spp) / spp_wanted; }
};

/// A reference that the viewer makes of what its panes show: what is asked for, and how far it is.
struct ReferenceMaking {
    bool show = false; ///< its dialog
    Method method = Method::gpr;
    int spp = 512;
    std::array<char, 1024> file{}; ///< empty: default_reference_file()
    bool anew = false;             ///< whatever checkpoint there is

    std::optional<ReferenceProgress> progress; ///< while it is made

    bool is_making() const { return progress.has_value(); }
};

/// A file in the current folder, named as `tessera bench` names references: after scene, size, depth, and the
/// camera unless it is the scene's.
std::filesystem::path default_reference_file(const Document& document);

/// The file that the dialog asks for, in full; its name ends in .exr.
std::filesystem::path wanted_reference_file(const Document& document);

/// How many seconds a reference will take if nothing else is rendered, by what a pane has taken, one of the same
/// method if there is any. Empty: no pane has a picture.
std::optional<double> estimated_seconds(const Document& document);

/// "45 s", "12 min", "3 h 5 min".
std::string duration_text(double seconds);

} // namespace tessera
