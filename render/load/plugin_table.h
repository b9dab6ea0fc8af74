#pragma once

#include <iterator>
#include <string_view>

namespace tessera {

/// A row of a table of plugins: the type in the file, and what reads it.
template <class Function>
struct Plugin {
    std::string_view type;
    Function read;
};

/// Null: there is no such plugin.
template <class Function, std::size_t count>
const Plugin<Function>* find_plugin(const Plugin<Function> (&table)[count], std::string_view type) {
    for (const Plugin<Function>& plugin : table)
        if (plugin.type == type)
            return &plugin;
    return nullptr;
}

} // namespace tessera
