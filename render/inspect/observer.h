#pragma once

#include "render/estimator/worker.h"
#include "render/inspect/inspection.h"

namespace tessera {

/// Records the shifts of one base path to all pixels of a sampling set.
class OffsetTrace final : public ShiftObserver {
public:
    /// End of a shifted light path (a slot of LightPaths), regardless of its visibility.
    struct End {
        bool is_there = false; ///< the shift reached the light
        bool joins = false;    ///< it reached it through `join`; `last` is then at a vertex of the base path
        OffsetStep join;
        OffsetStep last;
    };
    struct Path {
        std::vector<DisplayVertex> vertices; ///< y_1, y_2, ...
        std::vector<OffsetStep> bounces;     ///< at y_1, y_2, ..., to the next vertex of the offset path
        OffsetStep join;                     ///< the last reconnection to a vertex of the base path
        std::vector<End> ends;               ///< by slot
    };

    const Path& operator[](int m) const { return paths_[m]; }

    void begins(int offsets, int slots) override;
    void arrives(int m, const Vertex& y) override;
    void bounces(int m, const OffsetStep& step) override { at(m).bounces.push_back(step); }
    void joins(int m, const OffsetStep& step) override { at(m).join = step; }
    void ends(int m, int slot, const OffsetStep& last) override { end_at(m, slot) = {true, false, {}, last}; }
    void ends_beyond(int m, int slot, const OffsetStep& last) override {
        end_at(m, slot) = {true, true, at(m).join, last};
    }

private:
    Path& at(int m) { return paths_[m]; }
    End& end_at(int m, int slot) { return at(m).ends[slot]; }

    std::vector<Path> paths_;
};

/// Returns the vertices of a base path.
std::vector<InspectedVertex> inspect_path(const BasePath& path);

/// Observes reuse_paths() on a worker's set, and records base paths and shifts.
class Observer {
public:
    /// @param samples  samples per pixel so far, for footprints
    /// @param pixel    entry of the set whose shifts get InspectedShift::steps; -1: none
    Observer(Worker& worker, float samples, int pixel, InspectedSet& result);
    ~Observer();
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;

    void operator()(int base, const ReuseDecision& decision);

private:
    InspectedShift shift(int base, int m, float scale) const;
    int add_light_paths(int base, int m, float scale, InspectedShift& s) const;
    int first_attempt(int m) const;
    void add_places(int base, int m, InspectedShift& s) const;
    void add_steps(int base, int m, int slot, InspectedShift& s) const;
    void add_footprints(int base, int m, std::vector<InspectedStep>& steps) const;
    std::string_view ending_of(int slot) const;
    const BasePath& path(int k) const { return *worker_.set.paths[k]; }

    Worker& worker_;
    InspectedSet& result_;
    OffsetTrace trace_;
    float samples_;
    int pixel_;
};

} // namespace tessera
