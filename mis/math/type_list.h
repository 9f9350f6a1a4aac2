#pragma once

namespace mis {

/// Some types, as a value; a registry (`mis/policy/registry.h` …) is one.
template <class... Ts> struct TypeList {
};

/// Calls `f.template operator()<T>()` for each type T of the list, in its order.
template <class... Ts, class F> constexpr void for_each_type(TypeList<Ts...>, F&& f)
{
    (f.template operator()<Ts>(), ...);
}

}  // namespace mis
