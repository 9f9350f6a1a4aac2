#include "tests/support/statistics.h"

#include "mis/sampling/random.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

namespace mis {

double chi2_p_value(std::span<const double> observed, std::span<const double> expected)
{
    double statistic = 0, rare_observed = 0, rare_expected = 0;
    int cells = 0;
    const auto add_cell = [&](double o, double e) { statistic += (o - e) * (o - e) / e, ++cells; };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (!(expected[i] >= 0)) return 0;
        if (expected[i] == 0 && observed[i] > 0) return 0;
        if (expected[i] >= 5) add_cell(observed[i], expected[i]);
        else rare_observed += observed[i], rare_expected += expected[i];
    }
    if (rare_expected > 0) add_cell(rare_observed, rare_expected);
    if (cells < 2) return 1;
    return boost::math::cdf(complement(boost::math::chi_squared(cells - 1), statistic));
}

double z_bound(double false_alarm, int tests)
{
    return boost::math::quantile(complement(boost::math::normal(), false_alarm / (2.0 * tests)));
}

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t i)
{
    return choice_bits(random_words(seed, {0, i, 0}, Block::light));
}

}  // namespace mis
