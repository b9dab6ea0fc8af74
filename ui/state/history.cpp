#include "ui/state/history.h"

#include <utility>

namespace tessera {

namespace {

UndoPoint point_of(const Document& document) {
    UndoPoint point;
    for (const PaneState& pane : document.panes)
        point.panes.push_back(pane.settings);
    point.linked = document.linked;
    point.size = document.rendering.size;
    point.sensor = document.scene_info.sensor;
    point.camera = document.camera.camera();
    point.camera_distance = document.camera.distance();
    point.tone = document.display.tone;
    return point;
}

void take(const UndoPoint& point, Document& document) {
    document.linked = false; // set_pane_count() would copy the settings of linked panes
    document.set_pane_count(static_cast<int>(point.panes.size()));
    for (std::size_t i = 0; i < point.panes.size(); ++i)
        document.panes[i].settings = point.panes[i];
    document.linked = point.linked;
    document.rendering.size = point.size;
    if (point.sensor != document.scene_info.sensor && point.sensor)
        document.show_sensor(*point.sensor);
    document.scene_info.sensor = point.sensor;
    document.camera.put(point.camera, point.camera_distance);
    document.display.tone = point.tone;
}

} // namespace

void History::note(const Document& document, bool is_held) {
    if (is_held)
        return;
    UndoPoint point = point_of(document);
    if (now_ == point)
        return;
    if (now_) {
        before_.push_back(std::move(*now_));
        after_.clear();
    }
    if (before_.size() > most_points)
        before_.pop_front();
    now_ = std::move(point);
}

void History::go(Document& document, std::deque<UndoPoint>& from, std::deque<UndoPoint>& to) {
    if (from.empty() || !now_)
        return;
    to.push_back(std::move(*now_));
    now_ = std::move(from.back());
    from.pop_back();
    take(*now_, document);
    now_ = point_of(document); // the camera can differ from the stored one by rounding
}

} // namespace tessera
