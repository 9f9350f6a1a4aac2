#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace mis {

// How a report's fields are described: once each, by describe(visitor, report) beside its struct.
// describe() tells the visitor of every field, in the order of files: what it is called, and where
// its value stands, by the member function that is named after its kind:
//
//   format               which format a document has; no member
//   text, text_or_null   a string; one that is null where it is empty
//   flag                 a bool
//   count                a whole number, at least 0 or what is said
//   place                a rank: at least 1; 0 is null
//   number               at least 0, and always known
//   figure, size         any number, and one that is at least 0; NaN and infinite are null
//   interval             an Interval of sizes
//   value_and_interval   an Interval, and its value once more by itself
//   one_of               an enumerator or a bool, by its name
//   names, sizes         a list of strings; sizes by name
//   strategy_name        what the other fields of a Strategy are called
//   draws                its draws towards lights, and of the BSDF
//   resolution           width and height; null where they are 0
//   reason               a Reason, in words; null where there is none
//   index                of a strategy of the scene, by its name
//   object, maybe        a struct that is described itself; one that may be missing
//   list, unique         many of them; many of which each has a name of its own
//   by_name              many of them, by their names
//   sentences            what words/ says of it: written, and never read
//
// A reader is told of members that it may write to, a writer of const ones.

/// What a field is called in files, its unit, and where it does not stand.
struct Field {
    std::string_view key;
    std::string_view unit;    ///< in words; empty where there is none
    std::string_view column;  ///< in the table; empty where it stands in none
    bool is_later = false;    ///< reports that were made before there was this field lack it

    constexpr explicit Field(std::string_view name, std::string_view in = {})
        : key(name), unit(in), column(name)
    {
    }
    /// The same under another name in the table.
    constexpr Field as(std::string_view name) const
    {
        Field field = *this;
        field.column = name;
        return field;
    }
    /// The same, which is not in the table.
    constexpr Field outside_table() const { return as({}); }
    /// The same, which older reports lack.
    constexpr Field later() const
    {
        Field field = *this;
        field.is_later = true;
        return field;
    }
};

/// What numbers of reports are in.
namespace unit {
inline constexpr std::string_view luminance = "luminance", luminance2 = "luminance²",
                                  cpu_seconds = "CPU seconds", wall_seconds = "wall seconds",
                                  pixels = "pixels",
                                  per_luminance2_second = "1/(luminance² · CPU second)";
}  // namespace unit

/// Where the interval of a value_and_interval stands.
inline std::string interval_key(const Field& field) { return std::string(field.key) + "_interval"; }

/// T itself or const T: what one describe() reads and another writes.
template <class S, class T>
concept Either = std::same_as<std::remove_const_t<S>, T>;

/// An enumeration that says how its enumerators stand in files: names_of(E{}), in their order.
template <class E>
concept Named = std::is_enum_v<E> && requires(E e)
{
    names_of(e);
};

/// As it stands in files.
template <Named E> constexpr const char* name_of(E e)
{
    return names_of(e)[static_cast<std::size_t>(e)];
}

}  // namespace mis
