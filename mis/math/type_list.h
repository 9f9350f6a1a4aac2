#pragma once

#include <string_view>
#include <type_traits>

namespace mis {

/// Some types, as a value; a registry (`mis/policy/registry.h` …) is one.
template <class... Ts> struct TypeList {
};

/// Calls `f.template operator()<T>()` for each type T of the list, in its order.
template <class... Ts, class F> constexpr void for_each_type(TypeList<Ts...>, F&& f)
{
    (f.template operator()<Ts>(), ...);
}

/// Calls `f.template operator()<T>()` for the type whose T::name that is. Returns whether there is
/// one.
template <class... Ts, class F>
constexpr bool visit_named(TypeList<Ts...>, std::string_view name, F&& f)
{
    return ((Ts::name == name && (f.template operator()<Ts>(), true)) || ...);
}

namespace detail {
template <class Found, class... Rest> struct DistinctOf {
    using type = Found;
};
template <class... Found, class T, class... Rest>
struct DistinctOf<TypeList<Found...>, T, Rest...>
    : DistinctOf<std::conditional_t<(std::is_same_v<Found, T> || ...), TypeList<Found...>,
                                    TypeList<Found..., T>>,
                 Rest...> {
};
}  // namespace detail

/// Some types, each once, in the order in which they first stand.
template <class... Ts> using Distinct = typename detail::DistinctOf<TypeList<>, Ts...>::type;

}  // namespace mis
