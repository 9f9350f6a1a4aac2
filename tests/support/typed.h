#pragma once

#include "mis/math/type_list.h"

#include <gtest/gtest.h>

#include <string>

namespace mis {

/// A registry as GoogleTest wants it: one instance of a typed test per line.
template <class List> struct AsTypes;
template <class... Ts> struct AsTypes<TypeList<Ts...>> {
    using type = testing::Types<Ts...>;
};
template <class List> using TestedTypes = typename AsTypes<List>::type;

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
