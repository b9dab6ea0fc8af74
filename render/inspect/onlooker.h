#pragma once

#include "render/inspect/inspection.h"

namespace tessera {

/// A base path's vertices as one looks at them.
std::vector<InspectedVertex> look_at(const BasePath& path);

/// Looks on while the light of a worker's set is shared out (share_light).
class Onlooker {
public:
    /// @param pixel  the shifts to and from this entry of the set are told step by step; -1: none is
    Onlooker(Worker& worker, int pixel, InspectedSet& result);
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
    std::string_view ending_of(int slot) const;
    const BasePath& path(int k) const { return *worker_.set.paths[static_cast<std::size_t>(k)]; }

    Worker& worker_;
    InspectedSet& result_;
    OffsetTrace trace_;
    int pixel_;
};

} // namespace tessera
