#pragma once

#include "mis/math/raise.h"
#include "mis/math/type_list.h"

#include <optional>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace mis {

// What is registered or listed is found by its name here, and here alone: types by T::name, entries
// of a list by entry.name.

/// `found "lamber"; known are lambert, ggx`, and on a line of its own the nearest, where one is
/// near. what: "found policy".
std::string unknown_name(std::string_view what, std::string_view found,
                         std::span<const std::string_view> known);

/// The entry of that name, or nullptr.
template <std::ranges::forward_range List>
constexpr auto find_named(const List& list, std::string_view name)
    -> const std::ranges::range_value_t<List>*
{
    for (const auto& entry : list)
        if (entry.name == name) return &entry;
    return nullptr;
}

/// The names of the entries, in their order. They are views: the list must outlive them.
template <std::ranges::forward_range List> std::vector<std::string_view> names_in(const List& list)
{
    std::vector<std::string_view> names;
    for (const auto& entry : list) names.emplace_back(entry.name);
    return names;
}

/// The names of the types, in their order.
template <class... Ts> std::vector<std::string_view> names_in(TypeList<Ts...>)
{
    return {Ts::name...};
}

/// The entry of that name. Throws std::out_of_range. kind: "policy".
template <std::ranges::forward_range List>
const auto& require_named(const List& list, std::string_view kind, std::string_view name)
{
    if (const auto* entry = find_named(list, name)) return *entry;
    raise<std::out_of_range>(unknown_name("found " + std::string(kind), name, names_in(list)));
}

/// What `f.template operator()<T>()` returns for the type of that name. Throws std::out_of_range.
template <class... Ts, class F>
auto require_named(TypeList<Ts...> list, std::string_view kind, std::string_view name, F&& f)
{
    using Result = std::common_type_t<decltype(f.template operator()<Ts>())...>;
    std::optional<Result> result;
    visit_named(list, name, [&]<class T>() { result.emplace(f.template operator()<T>()); });
    if (!result)
        raise<std::out_of_range>(unknown_name("found " + std::string(kind), name, names_in(list)));
    return *std::move(result);
}

}  // namespace mis
