#pragma once

#include <cstddef>
#include <string_view>

namespace tessera {

/// Returns whether a value of an enum has a name. Compilers print a value without one as a cast: "(Kind)7".
template <auto value>
constexpr bool has_enumerator() {
    constexpr std::string_view before = "value = ";
    const std::string_view function = __PRETTY_FUNCTION__; // "... [with auto value = tessera::Kind::first]"
    return function[function.rfind(before) + before.size()] != '(';
}

template <class Enum, int first = 0>
constexpr std::size_t count_enumerators() {
    if constexpr (has_enumerator<static_cast<Enum>(first)>())
        return count_enumerators<Enum, first + 1>();
    else
        return first;
}

/// Number of enumerators of an enum class that counts from 0 without gaps. Tables indexed by an enumerator check
/// their size against it, so that the build fails when an enumerator lacks an entry.
template <class Enum>
inline constexpr std::size_t enumerator_count = count_enumerators<Enum>();

/// Returns the entry of a table with one entry for each enumerator.
template <class Enum, class T, std::size_t size>
    requires(size == enumerator_count<Enum>)
constexpr const T& entry_of(const T (&table)[size], Enum value) {
    return table[static_cast<std::size_t>(value)];
}

} // namespace tessera
