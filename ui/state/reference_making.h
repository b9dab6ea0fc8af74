#pragma once

#include "recon/metrics/metrics.h"
#include "render/settings/settings.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace tessera {

struct Document;

/// Progress of rendering a reference.
struct ReferenceProgress {
    std::filesystem::path file;
    int spp = 0, spp_wanted = 0;         ///< of both halves together
    int spp_resumed = 0;                 ///< spp from the checkpoint
    double seconds_left = 0;             ///< infinite: unknown
    std::optional<FloorFreeError> error; ///< of the mean of both halves so far
    bool is_ending = false;              ///< cancelled, and writing its checkpoint

    double share() const { return static_cast<double>(spp) / spp_wanted; }
};

/// Settings and progress of a reference that the viewer renders for the view of its panes.
struct ReferenceMaking {
    bool show = false; ///< whether the dialog is open
    Method method = Method::gpr;
    int spp = 512;
    std::array<char, 1024> file{}; ///< empty: default_reference_file()
    bool anew = false;             ///< ignores a checkpoint

    std::optional<ReferenceProgress> progress; ///< empty: none is being rendered

    bool is_making() const { return progress.has_value(); }
};

/// Returns a file in the current folder with the name that `tessera bench` uses: scene, size, depth, and a
/// checksum of the camera unless it is the scene's.
std::filesystem::path default_reference_file(const Document& document);

/// Returns the absolute path of the dialog's file; it ends in .exr.
std::filesystem::path wanted_reference_file(const Document& document);

/// Estimates the seconds for the reference if nothing else is rendered, from the time per pass of a pane,
/// preferably of one with the same method. Empty: no pane has a full pass.
std::optional<double> estimated_seconds(const Document& document);

/// Returns "45 s", "12 min" or "3 h 5 min".
std::string duration_text(double seconds);

} // namespace tessera
