#include "ui/state/document.h"

#include "render/scene/scene.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

glm::ivec2 Document::sensor_size() const {
    if (!scene)
        return {16, 9};
    const std::vector<Sensor>& sensors = scene->description().sensors;
    const std::size_t chosen = scene_info.sensor.value_or(sensors.size());
    return chosen < sensors.size() ? sensors[chosen].size : scene->size();
}

void Document::show_sensor(std::size_t index) {
    scene_info.sensor = index;
    camera.set_home(scene->description().sensors.at(index).camera, scene->center(), scene->radius());
    set_view({});
}

namespace {

bool has_small_factors(int n) {
    for (int factor : {2, 3, 5}) {
        while (n % factor == 0)
            n /= factor;
    }
    return n == 1;
}

// Returns the greatest number up to n whose prime factors are 2, 3 and 5.
int smooth_below(int n) {
    while (n > 1 && !has_small_factors(n))
        --n;
    return n;
}

glm::ivec2 within_limits(glm::vec2 size) {
    const glm::ivec2 rounded(glm::round(glm::clamp(size, glm::vec2(1), glm::vec2(most_render_pixels_an_edge))));
    return glm::max(rounded, glm::ivec2(1));
}

glm::ivec2 fitting(glm::ivec2 film_size, glm::ivec2 pane_size, float scale) {
    const glm::vec2 film = glm::max(film_size, glm::ivec2(1));
    const glm::vec2 pane = glm::max(pane_size, glm::ivec2(1));
    const float fit = std::min(pane.x / film.x, pane.y / film.y) * scale;
    const int width = smooth_below(within_limits(glm::floor(film * fit)).x);
    const float height = static_cast<float>(width) * film.y / film.x;
    return within_limits({static_cast<float>(width), std::min(std::round(height), std::ceil(pane.y * scale))});
}

} // namespace

glm::ivec2 render_size(const SizeChoice& choice, glm::ivec2 film_size, glm::ivec2 pane_size) {
    const float scale = std::clamp(choice.scale, 0.01f, 2.0f);
    switch (choice.base) {
    case SizeChoice::Base::pane:
        return fitting(film_size, pane_size, scale);
    case SizeChoice::Base::scene:
        return within_limits(glm::vec2(film_size) * scale);
    case SizeChoice::Base::custom:
        return within_limits(glm::vec2(choice.custom) * scale);
    }
    return {1, 1};
}

void Document::set_inspector(bool on) {
    inspector.active = on;
    slow_motion.active = slow_motion.active && !on;
}

void Document::set_slow_motion(bool on) {
    if (on && !slow_motion.active) {
        slow_motion.frames = true;
        slow_motion.held = false;
        slow_motion.sample.reset();
    }
    slow_motion.active = on;
    inspector.active = inspector.active && !on;
}

int Document::compared_with(int pane) const {
    const int count = static_cast<int>(panes.size()), with = panes[pane].settings.comparison.with;
    if (with == the_reference || (count == 1 && companions.reference))
        return the_reference;
    return with >= 0 && with < count && with != pane ? with : (pane + 1) % count;
}

} // namespace tessera
