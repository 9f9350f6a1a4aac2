#include "mis/predict/moments.h"

#include "mis/math/limits.h"

#include <cmath>

namespace mis {

namespace {

struct Central {
    Bounded mean, variance, fourth;
};

/// Central moments of one draw from those about `shift`; `rounding` as in figures_of.
Central central(const DrawMoments& draw, double rounding)
{
    const auto& [s1, s2, s3, s4] = draw.sums.value;
    const auto& [e1, e2, e3, e4] = draw.sums.error;
    const double a1 = std::abs(s1), a3 = std::abs(s3), c = std::abs(draw.shift);
    Central r;
    r.mean = {draw.shift + s1, e1 + rounding * (c + a1)};
    r.variance.value = s2 - s1 * s1;
    // X is off by rounding·|X| ≤ rounding·(|X − c| + |c|): by Cauchy and Schwarz, what that does to
    // E(X − c)².
    const double spread = std::sqrt(std::abs(s2));
    r.variance.error = e2 + 2 * a1 * e1 + e1 * e1 + rounding * (4 * s2 + 2 * c * spread) +
                       rounding * rounding * c * c;
    r.fourth.value = s4 - 4 * s1 * s3 + 6 * s1 * s1 * s2 - 3 * s1 * s1 * s1 * s1;
    const double size4 = s4 + 4 * a1 * a3 + 6 * a1 * a1 * s2 + 3 * a1 * a1 * a1 * a1;
    const double from_shift = c * rounding, spread4 = std::sqrt(std::sqrt(std::abs(s4)));
    r.fourth.error = e4 + 4 * (a3 * e1 + a1 * e3) + 6 * (2 * a1 * s2 * e1 + a1 * a1 * e2) +
                     12 * a1 * a1 * a1 * e1 + 8 * rounding * size4 +
                     4 * from_shift * spread4 * spread4 * spread4 +
                     from_shift * from_shift * from_shift * from_shift;
    return r;
}

void add_scaled(Bounded& to, const Bounded& from, double factor)
{
    to.value += factor * from.value, to.error += factor * from.error;
}

/// Half a draw: the moments of an equal mixture of two.
DrawMoments mixture(const DrawMoments& a, const DrawMoments& b)
{
    DrawMoments mixed;
    for (std::size_t m = 0; m < 4; ++m) {
        mixed.sums.value[m] = (a.sums.value[m] + b.sums.value[m]) / 2;
        mixed.sums.error[m] = (a.sums.error[m] + b.sums.error[m]) / 2;
    }
    return mixed;
}

/// What is no number came of a range left upwards: no double holds it.
void keep_in_range(Bounded& b)
{
    if (!std::isfinite(b.value)) b = {infinity, infinity};
    else if (!std::isfinite(b.error)) b.error = infinity;
}

}  // namespace

MomentFigures figures_of(const StrategyMoments& moments, double rounding)
{
    MomentFigures sum;
    Bounded cumulant;  // fourth: of independent draws it adds up, as mean and variance do
    const auto add = [&](const DrawMoments& draw, double draws) {
        const Central c = central(draw, rounding);
        add_scaled(sum.mean, c.mean, draws);
        add_scaled(sum.variance, c.variance, draws);
        add_scaled(cumulant,
                   {c.fourth.value - 3 * c.variance.value * c.variance.value,
                    c.fourth.error + 6 * std::abs(c.variance.value) * c.variance.error +
                        3 * c.variance.error * c.variance.error},
                   draws);
    };
    if (moments.is_one_sample) {
        add(mixture(moments.light.front(), moments.bsdf.front()), 1);
    } else {
        for (const DrawMoments& draw : moments.light) add(draw, draw.draws);
        for (const DrawMoments& draw : moments.bsdf) add(draw, draw.draws);
    }
    const double v = sum.variance.value, ev = sum.variance.error;
    sum.fourth = {cumulant.value + 3 * v * v, cumulant.error + 6 * std::abs(v) * ev + 3 * ev * ev};
    // Neither can be negative: where rounding made it so, 0 is nearer the truth.
    for (Bounded* b : {&sum.variance, &sum.fourth})
        if (b->value < 0) b->error -= b->value, b->value = 0;
    for (Bounded* b : {&sum.mean, &sum.variance, &sum.fourth}) keep_in_range(*b);
    return sum;
}

}  // namespace mis
