#pragma once

#include "mis/math/type_list.h"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

namespace mis {

/// A registry as GoogleTest wants it: one instance of a typed test per line.
template <class List> struct AsTypes;
template <class... Ts> struct AsTypes<TypeList<Ts...>> {
    using type = testing::Types<Ts...>;
};
template <class List> using TestedTypes = typename AsTypes<List>::type;

/// Those types of a list for which Keep<T>::value is true.
template <class... As, class... Bs>
TypeList<As..., Bs...> operator+(TypeList<As...>, TypeList<Bs...>)
{
    return {};
}
template <template <class> class Keep, class... Ts> auto filtered(TypeList<Ts...>)
{
    return (TypeList<>{} + ... + std::conditional_t<Keep<Ts>::value, TypeList<Ts>, TypeList<>>{});
}
template <class List, template <class> class Keep>
using Filtered = decltype(filtered<Keep>(List{}));

/// An instance is called by the name it registered.
struct RegisteredName {
    template <class C> static std::string GetName(int)
    {
        std::string name(C::name);
        for (char& c : name)
            if (c == '-') c = '_';
        return name;
    }
};

}  // namespace mis
