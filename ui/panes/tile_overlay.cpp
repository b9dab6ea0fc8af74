#include "render/estimator/tile_grid.h"
#include "ui/gl/theme.h"
#include "ui/inside/drawing.h"
#include "ui/panes/pane_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

constexpr float least_edge = 4;     // minimum distance of lines, screen units: denser lines look like a grey veil
constexpr float least_pattern = 10; // minimum edge of a pixel with a recognisable colour, screen units
constexpr ImU32 tile_colour = IM_COL32(255, 255, 255, 90), split_colour = IM_COL32(255, 255, 255, 45);
constexpr ImU32 shadow_colour = IM_COL32(0, 0, 0, 70);
constexpr ImU32 set_colour = IM_COL32(64, 196, 178, 70), set_edge_colour = IM_COL32(64, 196, 178, 255);
constexpr ImU32 halo_colour = IM_COL32(255, 168, 51, 90), halo_edge_colour = IM_COL32(255, 168, 51, 255);
constexpr ImU32 alone_colour = IM_COL32(51, 102, 255, 60); // pixels without path reuse

class TileDrawing {
public:
    TileDrawing(const PictureFrame& frame, const Snapshot& snapshot)
        : settings_(snapshot.settings), size_(snapshot.images->primal.width(), snapshot.images->primal.height()),
          grid_(size_, settings_, *snapshot.learned, snapshot.spp - 1), drawing_(frame, size_),
          unit_(drawing_.unit()) {
        const glm::vec2 from = frame.to_image(frame.rect.min) * glm::vec2(size_);
        const glm::vec2 to = frame.to_image(frame.rect.max) * glm::vec2(size_);
        visible_ = PixelRect{static_cast<int>(std::floor(from.x)), static_cast<int>(std::floor(from.y)),
                             static_cast<int>(std::ceil(to.x)), static_cast<int>(std::ceil(to.y))}
                       .clipped(size_);
    }

    void draw(std::optional<glm::vec2> place) {
        const float tile = static_cast<float>(settings_.tile);
        if (reuses_paths(settings_.method) && tile * unit_ >= least_edge && !visible_.empty()) {
            draw_lines();
            draw_tiles();
        }
        const glm::vec2 p = place.value_or(glm::vec2(-1)) * glm::vec2(size_);
        if (p.x >= 0 && p.y >= 0 && p.x < static_cast<float>(size_.x) && p.y < static_cast<float>(size_.y))
            draw_set(glm::ivec2(p));
    }

    std::string text(int pass) const {
        char line[160];
        const int n = settings_.tile;
        if (!reuses_paths(settings_.method))
            std::snprintf(line, sizeof line,
                          settings_.method == Method::gpt ? "G-PT: a pixel reuses the paths of its neighbours"
                                                          : "PT reuses no paths");
        else if (uses_rooks())
            std::snprintf(line, sizeof line, "pass %d: %d-rooks patterns, moved by (%d, %d)", pass, n,
                          grid_.origin.x, grid_.origin.y);
        else
            std::snprintf(line, sizeof line, "pass %d: tiles of %d x %d, moved by (%d, %d)%s", pass, n, n,
                          grid_.origin.x, grid_.origin.y,
                          settings_.method == Method::gpr ? ", with a border" : "");
        return line;
    }

private:
    bool uses_rooks() const { return settings_.method == Method::pr && settings_.pattern == Pattern::rooks; }
    void line(glm::ivec2 a, glm::ivec2 b, ImU32 colour) const {
        const ImVec2 from = drawing_.corner(a), to = drawing_.corner(b);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddLine({from.x + 1, from.y + 1}, {to.x + 1, to.y + 1}, shadow_colour);
        list.AddLine(from, to, colour);
    }
    void outline(PixelRect r, ImU32 colour) const {
        drawing_.outline(r, colour, std::max(ImGui::GetFontSize() / 10, 1.0f));
    }

    /// Draws the grid of tiles.
    void draw_lines() const {
        const PixelRect first = grid_.tile_at({visible_.x0, visible_.y0});
        for (int x = first.x0; x <= visible_.x1; x += settings_.tile)
            if (x >= visible_.x0)
                line({x, visible_.y0}, {x, visible_.y1}, tile_colour);
        for (int y = first.y0; y <= visible_.y1; y += settings_.tile)
            if (y >= visible_.y0)
                line({visible_.x0, y}, {visible_.x1, y}, tile_colour);
    }

    /// Draws the inside of tiles: tile splits, or the pixels of N-rooks patterns.
    void draw_tiles() {
        const PixelRect first = grid_.tile_at({visible_.x0, visible_.y0});
        for_each_square({first.x0, first.y0, visible_.x1, visible_.y1}, settings_.tile, [&](PixelRect tile) {
            const PixelRect whole{tile.x0, tile.y0, tile.x0 + settings_.tile, tile.y0 + settings_.tile};
            uses_rooks() ? draw_patterns(whole) : draw_cuts(whole);
        });
    }

    void draw_cuts(PixelRect tile) const {
        grid_.for_each_split(tile, [&](PixelRect split, int paths_without_reuse) {
            if (paths_without_reuse > 0)
                drawing_.fill(split, alone_colour);
            if (static_cast<float>(split.width()) * unit_ < least_edge)
                return;
            if (split.x0 > std::max(tile.x0, 0))
                line({split.x0, split.y0}, {split.x0, split.y1}, split_colour);
            if (split.y0 > std::max(tile.y0, 0))
                line({split.x0, split.y0}, {split.x1, split.y0}, split_colour);
        });
    }

    void draw_patterns(PixelRect tile) {
        if (unit_ < least_pattern)
            return;
        grid_.shuffle_columns(tile, columns_);
        for (int pattern = 0; pattern < settings_.tile; ++pattern) {
            ImVec4 c(0, 0, 0, 0.35f);
            ImGui::ColorConvertHSVtoRGB(static_cast<float>(pattern) / static_cast<float>(settings_.tile), 0.9f, 1,
                                        c.x, c.y, c.z);
            const ImU32 colour = ImGui::ColorConvertFloat4ToU32(c);
            grid_.for_each_rook(tile, columns_, pattern,
                                [&](int x, int y) { drawing_.fill(glm::ivec2(x, y), colour); });
        }
    }

    /// Marks the sampling sets that contribute to a pixel.
    void draw_set(glm::ivec2 p) {
        const PixelRect pixel{p.x, p.y, p.x + 1, p.y + 1};
        if (settings_.method == Method::gpt) {
            const PixelRect others = grid_.block_at(p).with_halo(size_);
            for (const glm::ivec2 to : {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-1, 0), glm::ivec2(0, -1)})
                if (others.contains(p + to))
                    drawing_.fill(p + to, halo_colour);
        } else if (uses_rooks()) {
            const PixelRect tile = grid_.tile_at(p);
            grid_.shuffle_columns(tile, columns_);
            grid_.for_each_rook(tile, columns_, grid_.pattern_at(p, tile, columns_), [&](int x, int y) {
                drawing_.fill(glm::ivec2(x, y), set_colour);
                outline({x, y, x + 1, y + 1}, set_edge_colour);
            });
        } else if (reuses_paths(settings_.method)) {
            const bool is_alone = grid_.paths_alone_at(p) > 0;
            const PixelRect split = is_alone ? pixel : grid_.split_at(p);
            drawing_.fill(split, set_colour);
            outline(split, set_edge_colour);
            if (settings_.method == Method::gpr && !is_alone) {
                const PixelRect all = split.with_halo(size_);
                drawing_.fill(PixelRect{split.x1, all.y0, all.x1, all.y1}, halo_colour);
                drawing_.fill(PixelRect{all.x0, split.y1, split.x1, all.y1}, halo_colour);
                grid_.for_each_split(grid_.block_at(p), [&](PixelRect other, int paths_without_reuse) {
                    if (paths_without_reuse == 0 && !other.contains(p) && other.with_halo(size_).contains(p))
                        outline(other.with_halo(size_), halo_edge_colour);
                });
            }
        }
        outline(pixel, IM_COL32(255, 255, 255, 220));
    }

    const RenderSettings& settings_;
    glm::ivec2 size_;
    TileGrid grid_;
    SetDrawing drawing_;
    float unit_; // edge of a pixel, screen units
    PixelRect visible_{0, 0, 0, 0};
    std::vector<int> columns_;
};

/// Draws a box with the text in the lower right corner.
void draw_text(const ScreenRect& where, const std::string& text) {
    const float pad = std::floor(ImGui::GetFontSize() * 0.4f);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 max(where.max.x - pad, where.max.y - pad), min(max.x - size.x - 2 * pad, max.y - size.y - pad);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, colours::overlay, pad * 0.5f);
    list.AddText({min.x + pad, min.y + pad * 0.5f}, colours::overlay_text, text.c_str());
}

} // namespace

void draw_tiles(const PictureFrame& frame, const ScreenRect& clip, const Snapshot& snapshot,
                std::optional<glm::vec2> place) {
    if (!snapshot.learned || !snapshot.images || snapshot.images->primal.empty() || snapshot.spp < 1)
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({clip.min.x, clip.min.y}, {clip.max.x, clip.max.y}, true);
    TileDrawing drawing(frame, snapshot);
    drawing.draw(place);
    draw_text(clip, drawing.text(snapshot.spp - 1));
    list.PopClipRect();
}

} // namespace tessera
