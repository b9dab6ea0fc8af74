#pragma once

#include "render/estimator/worker.h"
#include "render/inspect/inspection.h"

namespace tessera {

/// What shifts did to all offset paths, one a pixel of the sampling set.
class OffsetTrace final : public ShiftOnlooker {
public:
    /// How a light path, a slot of LightPaths, ended in the offset, whatever visibility made of it then.
    struct End {
        bool is_there = false;
        bool joins = false; ///< it goes through `join` to the base's own vertex, where `last` is
        OffsetStep join;
        OffsetStep last;
    };
    struct Path {
        std::vector<SeenVertex> vertices; ///< y_1, y_2, ...
        std::vector<OffsetStep> bounces;  ///< at y_1, y_2, ..., those that led to another vertex
        OffsetStep join;                  ///< the newest to a vertex of the base path
        std::vector<End> ends;            ///< one a slot
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

/// A base path's vertices as one looks at them.
std::vector<InspectedVertex> inspect_path(const BasePath& path);

/// Looks on while the light of a worker's set is shared out (reuse_paths).
class Onlooker {
public:
    /// @param samples  a pixel so far, of which footprints are
    /// @param pixel    the shifts to and from this entry of the set are told step by step; -1: none is
    Onlooker(Worker& worker, float samples, int pixel, InspectedSet& result);
    ~Onlooker();
    Onlooker(const Onlooker&) = delete;
    Onlooker& operator=(const Onlooker&) = delete;

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
