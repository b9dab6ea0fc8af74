#pragma once

#include "render/load/json_text.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace tessera {

/// An object of the file, and where it stands in it. What is wrong with a field is told with its place.
class JsonFields {
public:
    using Json = nlohmann::ordered_json;

    JsonFields(const JsonText& text, const Json& json, std::string path)
        : text_(text), json_(json), path_(std::move(path)) {
        if (!json.is_object())
            fail("", "this must be an object, {...}");
    }

    [[noreturn]] void fail(const std::string& key, const std::string& what) const {
        text_.fail_at(text_.place_of(path_ + key), what);
    }

    const Json& json() const { return json_; }
    bool has(const char* key) const { return json_.contains(key); }
    /// Without fields where there is none of that name.
    JsonFields object(const std::string& key) const {
        static const Json none = Json::object();
        return {text_, json_.contains(key) ? json_.at(key) : none, path_ + key + "/"};
    }
    JsonFields element(const Json& array, std::size_t i, const std::string& key) const {
        return {text_, array[i], path_ + key + "/" + std::to_string(i) + "/"};
    }

    template <class T>
    T get(const std::string& key) const {
        try {
            return json_.at(key).get<T>();
        } catch (const Json::exception&) {
            fail(key, key + " is of the wrong kind: " + json_.at(key).type_name());
        }
    }
    /// `take` gets the value, and throws std::invalid_argument where it is no good.
    template <class T, class Take>
    void read(const std::string& key, Take take) const {
        if (!json_.contains(key))
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
    void read(const std::string& key, double least, double most, Number& value) const {
        read<double>(key, [&](double number) {
            if (!(number >= least && number <= most))
                throw std::invalid_argument(key + " is out of range");
            value = static_cast<Number>(number);
        });
    }
    void read(const std::string& key, bool& value) const {
        read<bool>(key, [&](bool on) { value = on; });
    }

private:
    const JsonText& text_;
    const Json& json_;
    std::string path_; // of all its fields, before their names
};

} // namespace tessera
