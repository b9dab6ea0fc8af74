#pragma once

#include "render/io/json_text.h"
#include "render/settings/setting.h"
#include "ui/state/words.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace tessera {

/// Records which fields of a file's objects have been read. Other fields are misspelt, or of another version.
class JsonReading {
public:
    using Json = nlohmann::ordered_json;

    explicit JsonReading(const JsonText& text) : text_(text) {}

    const JsonText& text() const { return text_; }
    void opens(const std::string& path, const Json& object) { opened_[path].object = &object; }
    void asks(const std::string& path, const std::string& key) { opened_[path].keys.insert(key); }

    /// Returns a line with position for each field that has not been asked for in the opened objects.
    std::vector<std::string> unknown() const {
        std::vector<std::string> lines;
        for (const auto& [path, opened] : opened_)
            for (const auto& [key, value] : opened.object->items())
                if (!opened.keys.contains(key))
                    lines.push_back(text_.position_of(path + key).to_string() + ": the unknown field \"" + key +
                                    "\" is ignored");
        return lines;
    }

private:
    struct Opened {
        const Json* object = nullptr;
        std::set<std::string> keys;
    };
    const JsonText& text_;
    std::map<std::string, Opened> opened_; // key: path
};

/// Reads an object of a JSON file. Errors in a field throw LoadError with line and column.
class JsonFields {
public:
    using Json = nlohmann::ordered_json;

    /// @param path  prefix of the names of all fields
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
    /// Returns the object of that name, or an empty object if there is none.
    JsonFields object(const std::string& key) const {
        static const Json none = Json::object();
        return {reading_, has(key) ? json_.at(key) : none, path_ + key + "/"};
    }
    JsonFields element(const Json& array, std::size_t i, const std::string& key) const {
        return {reading_, array[i], path_ + key + "/" + std::to_string(i) + "/"};
    }

    /// Returns the field as a bool, a string, a number, or if T is unsigned a whole number of 0 or more.
    template <class T>
    T get(const std::string& key) const {
        const Json& value = json_.at(key);
        // The library converts true to a number, and -1 to the largest unsigned number.
        const bool fits = std::is_same_v<T, bool>   ? value.is_boolean()
                          : std::is_unsigned_v<T>   ? value.is_number_unsigned()
                          : std::is_arithmetic_v<T> ? value.is_number()
                                                    : value.is_string();
        if (!fits && std::is_unsigned_v<T> && !std::is_same_v<T, bool> && value.is_number())
            fail(key, key + " must be a whole number, 0 or more");
        if (!fits)
            fail(key, key + " has the wrong type: " + value.type_name());
        return value.get<T>();
    }
    /// Passes the value to `take`, which throws std::invalid_argument if it rejects the value.
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
    /// Reads a setting, which is a number, true or false, or a string, under its id or under `key`.
    void read(const Setting& setting) const { read(std::string(setting.id), setting); }
    void read(const std::string& key, const Setting& setting) const {
        using S = Setting;
        if (const auto* on = std::get_if<S::Switch>(&setting.kind))
            read(key, *on->value);
        else if (const auto* natural = std::get_if<S::Natural>(&setting.kind))
            read<std::uint64_t>(key, [&](std::uint64_t value) { *natural->value = value; });
        else if (const auto* whole = std::get_if<S::Whole>(&setting.kind))
            read(key, Range{double(whole->least), double(whole->most)}, *whole->value);
        else if (const auto* real = std::get_if<S::Real>(&setting.kind))
            read(key, Range{real->least, real->most}, *real->value);
        else if (const auto* seconds = std::get_if<S::Seconds>(&setting.kind))
            read(key, Range{seconds->least, seconds->most}, *seconds->value);
        else
            read<std::string>(key, [&](const std::string& text) { setting.set_text(text); });
    }
    template <class Enum, std::size_t count>
    void read(const std::string& key, const SettingChoice (&choices)[count], Enum& value) const {
        read(key, Setting{key, "", "", one_of(choices, value)});
    }

private:
    JsonReading& reading_;
    const Json& json_;
    std::string path_;
};

} // namespace tessera
