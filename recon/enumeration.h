#pragma once

#include <cstddef>
#include <string_view>

namespace tessera {

/// Whether a value of an enum has a name. Compilers spell a value that has none as a cast: "(Kind)7".
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

/// How many enumerators an enum class has that counts from 0 without gaps. It is counted by the compiler, so that
/// a table by position cannot be forgotten when an enumerator is added: the build fails.
template <class Enum>
inline constexpr std::size_t enumerator_count = count_enumerators<Enum>();

/// The entry that a table by position has for a value. Only for tables that have one for each.
template <class Enum, class T, std::size_t size>
    requires(size == enumerator_count<Enum>)
constexpr const T& entry_of(const T (&table)[size], Enum value) {
    return table[static_cast<std::size_t>(value)];
}

} // namespace tessera
