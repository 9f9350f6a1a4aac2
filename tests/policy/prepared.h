#pragma once

#include "mis/engine/light_columns.h"
#include "mis/math/frame.h"
#include "mis/math/lanes.h"
#include "mis/policy/light_choice.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace mis {

/// What a policy says at one point, whichever policy it is.
class PreparedPoint {
public:
    virtual ~PreparedPoint() = default;
    virtual Choice choose(std::uint64_t bits) const = 0;
    virtual double probability(std::size_t j) const = 0;

    std::vector<double> probabilities() const
    {
        std::vector<double> all(count_);
        for (std::size_t j = 0; j < count_; ++j) all[j] = probability(j);
        return all;
    }
    double sum() const
    {
        const std::vector<double> all = probabilities();
        return std::accumulate(all.begin(), all.end(), 0.0);
    }

protected:
    explicit PreparedPoint(std::size_t lights) : count_(lights) {}

private:
    std::size_t count_;
};

/// A policy's table for one point, with all that it stands on. T: float, double or lanes.
template <class P, class T = double> class Prepared final : public PreparedPoint {
public:
    using S = Scalar<T>;
    Prepared(const Lights& lights, const Vec3<double>& x, const Vec3<double>& n)
        : Prepared(lights, x, n, x)
    {
    }
    /// origin: of the lights' columns. wo in scene axes.
    Prepared(const Lights& lights, const Vec3<double>& x, const Vec3<double>& n,
             const Vec3<double>& origin, const Vec3<double>& wo = {0, 0, 1},
             const AnyBsdf& bsdf = {})
        : PreparedPoint(lights.size()), policy_(lights),
          columns_(fill_light_columns(lights, origin, storage_)),
          scratch_(P::table_bytes(lights.size()) + 64),
          table_(
              policy_.template prepare<T>({vec_cast<S>(x - origin), vec_cast<S>(n),
                                           vec_cast<S>(frame_around(n).to_local(wo)), bsdf, origin},
                                          columns_, scratch_))
    {
    }
    const auto& table() const { return table_; }
    Choice choose(std::uint64_t bits) const override { return table_.choose(bits); }
    double probability(std::size_t j) const override
    {
        return table_.probability(static_cast<LightIndex>(j));
    }

private:
    P policy_;
    LargeVector<S> storage_;
    LightColumns<S> columns_;
    Scratch scratch_;
    decltype(policy_.template prepare<T>(std::declval<const ChoicePoint<S>&>(), columns_,
                                         scratch_)) table_;
};

/// A light at distance 2 in the +x direction whose rim is `rise` (of sines) above the horizon of a
/// point x with normal +y; sin_max is the sine of its half-angle.
inline Light low_light(const Vec3<double>& x, double sin_max, double rise)
{
    const double c = rise - sin_max;
    return make_light_of_power(x + Vec3<double>(2 * std::sqrt(1 - c * c), 2 * c, 0), 2 * sin_max,
                               Vec3<double>(1));
}

}  // namespace mis
