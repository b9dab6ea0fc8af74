#include "render/scene/sensor.h"

#include "recon/enumeration.h"
#include "render/io/text.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <fmt/core.h>

namespace tessera {

namespace {
constexpr std::string_view format_names[] = {"luminance", "luminance_alpha", "rgb", "rgba", "xyz", "xyza"};
}

std::string_view to_string(PixelFormat format) {
    return entry_of(format_names, format);
}

std::optional<PixelFormat> pixel_format_from_name(std::string_view name) {
    const auto found = std::ranges::find(format_names, lower_case(std::string(name)));
    if (found == std::end(format_names))
        return {};
    return static_cast<PixelFormat>(found - std::begin(format_names));
}

std::string list_of(const std::vector<Sensor>& sensors) {
    std::string text;
    for (std::size_t i = 0; i < sensors.size(); ++i)
        text += fmt::format("{}{}{}", i == 0 ? "" : ", ", i,
                            sensors[i].id.empty() ? "" : fmt::format(" ({})", sensors[i].id));
    return text;
}

std::size_t find_sensor(const std::vector<Sensor>& sensors, std::string_view number_or_id) {
    const auto found = std::ranges::find(sensors, number_or_id, &Sensor::id);
    if (found != sensors.end() && !number_or_id.empty())
        return static_cast<std::size_t>(found - sensors.begin());
    for (std::size_t i = 0; i < sensors.size(); ++i)
        if (number_or_id == std::to_string(i))
            return i;
    throw std::runtime_error(fmt::format("there is no sensor '{}'; the scene has {}", number_or_id,
                                         sensors.empty() ? "none" : list_of(sensors)));
}

} // namespace tessera
