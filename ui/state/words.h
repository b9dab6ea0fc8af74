#pragma once

#include "recon/enumeration.h"
#include "render/io/json_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace tessera {

/// What settings files, scripts and the log call the values of enums, in their order.
namespace words {
inline constexpr const char* off_on[] = {"off", "on"};
inline constexpr const char* sizes[] = {"pane", "scene", "custom"};         // SizeChoice::Base
inline constexpr const char* tones[] = {"srgb", "gamma", "filmic"};         // Tone::Curve
inline constexpr const char* comparisons[] = {"off", "wipe", "difference"}; // Comparison::Kind
inline constexpr const char* shares[] = {"time", "spp"};                    // Pace::Equal
inline constexpr const char* charts[] = {"error", "efficiency", "shifts"};  // ChartKind
inline constexpr const char* chart_axes[] = {"seconds", "spp"};             // ViewerState::charts_by_spp
inline constexpr const char* themes[] = {"dark", "light"};                  // Theme
inline constexpr const char* directions[] = {"to_pixel", "from_pixel"};     // Inspector::Direction
} // namespace words

static_assert(std::size(words::off_on) == 2 && std::size(words::chart_axes) == 2); // of a bool

/// Not of a bool: of an enum whose words these are.
template <class Enum, std::size_t count>
const char* word(const char* const (&words)[count], Enum value) {
    return entry_of(words, value);
}

/// "kind_mismatch" as it is written in prose.
inline std::string in_words(std::string_view name) {
    std::string text(name);
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

/// Where a setting may lie, whoever sets it.
struct Range {
    double least, most;

    float low() const { return static_cast<float>(least); }
    float high() const { return static_cast<float>(most); }
};

namespace ranges {
inline constexpr int most_spp = 1 << 24;
inline constexpr double most_seconds = 1e7;
inline constexpr Range alpha{1e-4, 1e3}, alpha_slider{0.001, 10}, exposure{-10, 10}, gamma{1, 4},
    spp_limit{0, most_spp}, reference_spp{2, most_spp}, seconds_limit{0, most_seconds};
} // namespace ranges

/// What a reader has asked of a file's objects: the rest is misspelt, or of another version.
class JsonReading {
public:
    using Json = nlohmann::ordered_json;

    explicit JsonReading(const JsonText& text) : text_(text) {}

    const JsonText& text() const { return text_; }
    void opens(const std::string& path, const Json& object) { opened_[path].object = &object; }
    void asks(const std::string& path, const std::string& key) { opened_[path].keys.insert(key); }

    /// A line for each field of the objects opened that nobody has asked for, with its place.
    std::vector<std::string> unknown() const {
        std::vector<std::string> lines;
        for (const auto& [path, opened] : opened_)
            for (const auto& [key, value] : opened.object->items())
                if (!opened.keys.contains(key))
                    lines.push_back(text_.position_of(path + key).to_string() + ": there is no \"" + key +
                                    "\": it is ignored");
        return lines;
    }

private:
    struct Opened {
        const Json* object = nullptr;
        std::set<std::string> keys;
    };
    const JsonText& text_;
    std::map<std::string, Opened> opened_; // by path
};

/// An object of the file, and where it stands in it. What is wrong with a field is told with its place.
class JsonFields {
public:
    using Json = nlohmann::ordered_json;

    /// `path`: of all its fields, before their names.
    JsonFields(JsonReading& reading, const Json& json, std::string path)
        : reading_(reading), json_(json), path_(std::move(path)) {
        if (!json.is_object())
            fail("", "this must be an object, {...}");
        reading_.opens(path_, json);
    }

    [[noreturn]] void fail(const std::string& key, const std::string& what) const {
        reading_.text().fail_at(reading_.text().place_of(path_ + key), what);
    }

    const Json& json() const { return json_; }
    bool has(const std::string& key) const {
        reading_.asks(path_, key);
        return json_.contains(key);
    }
    /// Without fields where there is none of that name.
    JsonFields object(const std::string& key) const {
        static const Json none = Json::object();
        return {reading_, has(key) ? json_.at(key) : none, path_ + key + "/"};
    }
    JsonFields element(const Json& array, std::size_t i, const std::string& key) const {
        return {reading_, array[i], path_ + key + "/" + std::to_string(i) + "/"};
    }

    /// A bool, a number, a whole one from 0 on where T is unsigned, or a string.
    template <class T>
    T get(const std::string& key) const {
        const Json& value = json_.at(key);
        // The library would make a number of true, and of -1 the largest there is.
        const bool fits = std::is_same_v<T, bool>   ? value.is_boolean()
                          : std::is_unsigned_v<T>   ? value.is_number_unsigned()
                          : std::is_arithmetic_v<T> ? value.is_number()
                                                    : value.is_string();
        if (!fits && std::is_unsigned_v<T> && !std::is_same_v<T, bool> && value.is_number())
            fail(key, key + " must be a whole number, 0 or more");
        if (!fits)
            fail(key, key + " is of the wrong kind: " + value.type_name());
        return value.get<T>();
    }
    /// `take` gets the value, and throws std::invalid_argument where it is no good.
    template <class T, class Take>
    void read(const std::string& key, Take take) const {
        if (!has(key))
            return;
        try {
            take(get<T>(key));
        } catch (const std::invalid_argument& error) {
            fail(key, error.what());
        }
    }
    template <class Enum, std::size_t count>
    void read(const std::string& key, const char* const (&words)[count], Enum& value) const {
        read<std::string>(key, [&](const std::string& text) {
            const auto found = std::find(std::begin(words), std::end(words), text);
            if (found == std::end(words))
                throw std::invalid_argument(key + " is \"" + text + "\", which there is not");
            value = static_cast<Enum>(found - std::begin(words));
        });
    }
    template <class Number>
    void read(const std::string& key, Range range, Number& value) const {
        read<double>(key, [&](double number) {
            if (!(number >= range.least && number <= range.most))
                throw std::invalid_argument(key + " is out of range");
            value = static_cast<Number>(number);
        });
    }
    void read(const std::string& key, bool& value) const {
        read<bool>(key, [&](bool on) { value = on; });
    }

private:
    JsonReading& reading_;
    const Json& json_;
    std::string path_;
};

} // namespace tessera
