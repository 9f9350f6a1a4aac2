#pragma once

#include "mis/math/vec.h"

#include <cmath>
#include <vector>

namespace mis {

/// Numbers of [0, 1) at which formulas end or fold: the least of T and the least that random
/// numbers give, the last ones below 1, and those about ¼, ½ and ¾; `each` of every kind.
template <class T> std::vector<T> ends_of_unit(int each)
{
    std::vector<T> ends{T(0)};
    T least = T(0), last = T(1);
    for (int k = 1; k <= each; ++k) {
        ends.push_back(least = std::nextafter(least, T(1)));
        ends.push_back(static_cast<T>(k * 0x1p-32));
        ends.push_back(last = std::nextafter(last, T(0)));
    }
    for (const T middle : {T(0.25), T(0.5), T(0.75)}) {
        T above = middle, below = middle;
        ends.push_back(middle);
        for (int k = 0; k < each; ++k) {
            ends.push_back(above = std::nextafter(above, T(1)));
            ends.push_back(below = std::nextafter(below, T(0)));
        }
    }
    return ends;
}

/// Pairs of them: all of one beside some of the other, in both orders.
template <class T> std::vector<Vec2<T>> ends_of_square(int many, int few)
{
    std::vector<Vec2<T>> ends;
    for (const T a : ends_of_unit<T>(many))
        for (const T b : ends_of_unit<T>(few)) ends.push_back({a, b}), ends.push_back({b, a});
    return ends;
}

}  // namespace mis
