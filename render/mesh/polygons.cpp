#include "render/mesh/mesh_file.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

// Limit on the tests of a point against an ear, not tuned. Ear clipping takes quadratic time for most polygons and
// cubic time for some.
constexpr std::size_t max_tests = 1'000'000'000;

/// Returns a vector along the normal of a triangle, of twice its area.
glm::dvec3 area_vector(const Mesh& mesh, glm::uvec3 t) {
    const glm::dvec3 corner = mesh.positions[t.x];
    return glm::cross(glm::dvec3(mesh.positions[t.y]) - corner, glm::dvec3(mesh.positions[t.z]) - corner);
}

double cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Cuts ears off one polygon in the plane, whose corners run counter-clockwise.
class EarClipping {
public:
    explicit EarClipping(std::vector<glm::dvec2> corners) : points_(std::move(corners)) {
        for (std::size_t i = 0; i < points_.size(); ++i) {
            next_.push_back((i + 1) % points_.size());
            previous_.push_back((i + points_.size() - 1) % points_.size());
        }
    }

    /// Returns triangles of corner indices, two fewer than there are corners.
    std::vector<glm::uvec3> run() {
        std::size_t at = 0;
        for (std::size_t left = points_.size(); left > 3; --left) {
            const std::size_t ear = find_ear(at, left);
            add(ear);
            next_[previous_[ear]] = next_[ear];
            previous_[next_[ear]] = previous_[ear];
            at = next_[next_[ear]]; // skipping a corner makes fewer thin triangles
        }
        add(at);
        is_simple_ = is_simple_ && turn(at) >= 0;
        return std::move(triangles_);
    }
    /// Returns false if edges cross, or if the polygon takes too many tests. Triangles then overlap.
    bool is_simple() const { return is_simple_; }

private:
    enum class Test { free, touched, flat }; // from the best kind of ear to the worst

    /// Returns the best ear, or the first corner if there is none.
    std::size_t find_ear(std::size_t first, std::size_t left) {
        for (const Test test : {Test::free, Test::touched, Test::flat}) {
            std::size_t at = first;
            for (std::size_t i = 0; i < left && tests_ < max_tests; ++i, at = next_[at])
                if (is_ear(at, test))
                    return at;
        }
        is_simple_ = false;
        return first;
    }

    double turn(std::size_t at) const { return cross(points_[previous_[at]], points_[at], points_[next_[at]]); }

    bool is_ear(std::size_t at, Test test) {
        if (test == Test::flat)
            return turn(at) == 0;
        if (!(turn(at) > 0))
            return false;
        for (std::size_t i = next_[next_[at]]; i != previous_[at]; i = next_[i], ++tests_)
            if (turn(i) <= 0 && is_inside(points_[i], at, test == Test::free))
                return false;
        return true;
    }

    /// Returns whether a point is in the triangle at a corner. Points at its corners are not; `closed` says
    /// whether those on its edges are.
    bool is_inside(glm::dvec2 p, std::size_t at, bool closed) const {
        const glm::dvec2 a = points_[previous_[at]], b = points_[at], c = points_[next_[at]];
        if (p == a || p == b || p == c)
            return false;
        const double sides[] = {cross(a, b, p), cross(b, c, p), cross(c, a, p)};
        for (const double side : sides)
            if (closed ? side < 0 : side <= 0)
                return false;
        return true;
    }

    void add(std::size_t at) { triangles_.emplace_back(previous_[at], at, next_[at]); }

    std::vector<glm::dvec2> points_;
    std::vector<std::size_t> next_, previous_; // corners that are left, as a ring
    std::vector<glm::uvec3> triangles_;
    std::size_t tests_ = 0;
    bool is_simple_ = true;
};

/// Projects corners along the axis that is closest to `normal`, so that they run counter-clockwise.
std::vector<glm::dvec2> project(const Mesh& mesh, const std::vector<std::uint32_t>& corners, glm::dvec3 normal) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(normal[i]) > std::abs(normal[axis]))
            axis = i;
    int x = (axis + 1) % 3, y = (axis + 2) % 3;
    if (normal[axis] < 0)
        std::swap(x, y);
    std::vector<glm::dvec2> points;
    points.reserve(corners.size());
    for (const std::uint32_t corner : corners)
        points.emplace_back(mesh.positions[corner][x], mesh.positions[corner][y]);
    return points;
}

/// Cuts a polygon that is no fan. Returns false if its triangles overlap, because edges cross or are too many.
bool cut(Mesh& mesh, const PolygonFan& polygon) {
    glm::uvec3* const triangles = mesh.triangles.data() + polygon.first_triangle;
    const std::size_t count = polygon.corners - 2;
    glm::dvec3 normal(0);
    for (std::size_t i = 0; i < count; ++i)
        normal += area_vector(mesh, triangles[i]);
    bool is_fan = true, is_flat = true;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 area = area_vector(mesh, triangles[i]);
        is_fan = is_fan && glm::dot(area, normal) > 0;
        is_flat = is_flat && area == glm::dvec3(0);
    }
    if (is_fan || is_flat)
        return true;
    const double size = glm::dot(normal, normal);
    if (!std::isfinite(size)) // repair_mesh() reports the corner
        return true;
    if (!(size > 0))
        return false;
    std::vector<std::uint32_t> corners{triangles[0].x, triangles[0].y};
    for (std::size_t i = 0; i < count; ++i)
        corners.push_back(triangles[i].z);
    EarClipping clipping(project(mesh, corners, normal));
    const std::vector<glm::uvec3> ears = clipping.run();
    for (std::size_t i = 0; i < count; ++i)
        triangles[i] = {corners[ears[i].x], corners[ears[i].y], corners[ears[i].z]};
    return clipping.is_simple();
}

} // namespace

std::size_t cut_polygons(Mesh& mesh, std::span<const PolygonFan> polygons) {
    std::size_t uncut = 0;
    for (const PolygonFan& polygon : polygons)
        uncut += !cut(mesh, polygon);
    return uncut;
}

} // namespace tessera
