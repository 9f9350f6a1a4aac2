#pragma once

#include <array>

namespace mis {

/// ∫ f over [a, b] by eight Gauss–Legendre nodes in each of `panels` equal parts: exact to rounding
/// where f is a polynomial of degree 15 on each part. Source of the nodes: Abramowitz and Stegun
/// 1964, table 25.4.
template <class F> double integrate(const F& f, double a, double b, int panels)
{
    struct Node {
        double at, weight;  ///< of the pair ±at, on [−1, 1]
    };
    constexpr std::array<Node, 4> nodes{{{0.183434642495649805, 0.362683783378361983},
                                         {0.525532409916328986, 0.313706645877887287},
                                         {0.796666477413626740, 0.222381034453374471},
                                         {0.960289856497536232, 0.101228536290376259}}};
    const double half = (b - a) / panels / 2;
    double sum = 0;
    for (int panel = 0; panel < panels; ++panel) {
        const double middle = a + (2 * panel + 1) * half;
        for (const Node& node : nodes)
            sum += node.weight * (f(middle - node.at * half) + f(middle + node.at * half));
    }
    return sum * half;
}

}  // namespace mis
