#include "mis/predict/rule.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace mis {

const Rule& rule()
{
    static const Rule filled = [] {
        using boost::math::quadrature::gauss;
        using boost::math::quadrature::gauss_kronrod;
        // Boost lists the nodes x ≥ 0 alone, 0 first; every second one is Gauss's.
        const auto& x = gauss_kronrod<double, Rule::nodes>::abscissa();
        const auto& kronrod = gauss_kronrod<double, Rule::nodes>::weights();
        const auto& gauss_weight = gauss<double, Rule::nodes / 2>::weights();
        Rule r;
        constexpr std::size_t middle = Rule::nodes / 2;
        for (std::size_t i = 0; i <= middle; ++i) {
            const double g = i % 2 == 0 ? gauss_weight[i / 2] : 0;
            r.x[middle + i] = x[i], r.x[middle - i] = -x[i];
            r.kronrod[middle + i] = r.kronrod[middle - i] = kronrod[i];
            r.gauss[middle + i] = r.gauss[middle - i] = g;
        }
        return r;
    }();
    return filled;
}

}  // namespace mis
