#pragma once

#include "mis/engine/light_columns.h"
#include "mis/math/cap.h"
#include "mis/trace/lights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace mis {

/// The lights of a host's scene, made ready for one policy at a time: the hierarchy over them, the
/// policy's own tables, and the columns it reads. Allocates when it is made and when lights change,
/// never between. Many threads may read it.
///
/// Lights: centres in scene units, radii > 0, radiance finite and not negative (find_light_problem
/// in mis/scene/validate.h says what is wrong with one). There may be none: then nothing is lit.
/// T: float or double, the number type of directions, densities and radiance.
template <class Policy, class T = float> class DirectLights {
public:
    /// Makes them ready: O(M log M).
    explicit DirectLights(Lights lights)
        : lights_(std::move(lights)), hierarchy_(lights_), policy_(lights_)
    {
        fill_columns();
    }
    DirectLights(const DirectLights&) = delete;  // the hierarchy refers to the lights
    DirectLights& operator=(const DirectLights&) = delete;

    /// As they were given.
    const Lights& lights() const { return lights_; }
    /// Which light does a ray meet?
    const LightHierarchy& hierarchy() const { return hierarchy_; }
    /// Which light to draw towards?
    const Policy& policy() const { return policy_; }
    /// The lights as policies read them, relative to origin().
    const LightColumns<T>& columns() const { return columns_; }
    /// What the columns are relative to: amid the lights, so that one far away moves it little.
    const Vec3<double>& origin() const { return origin_; }

    /// Other lights: moved, brighter, more or fewer. Costs what the constructor costs, O(M log M)
    /// for the hierarchy; points made before are prepared again by move_to.
    void assign(Lights lights)
    {
        lights_ = std::move(lights);
        hierarchy_ = LightHierarchy(lights_);
        policy_ = Policy(lights_);
        fill_columns();
    }

    /// Another radiance for light j, W·sr⁻¹·m⁻², with the sphere as it is: the hierarchy stays.
    /// O(1) for policies that look at all lights at each point; the others are made anew. Points
    /// made before are prepared again by move_to.
    void recolor(LightIndex j, const Vec3<double>& radiance)
    {
        Light& light = lights_[static_cast<std::size_t>(j)];
        light = make_light(light.center, light.radius, radiance);
        luminance_[static_cast<std::size_t>(j)] = static_cast<T>(luminance_radius(light));
        if constexpr (!Policy::reads_all_lights) policy_ = Policy(lights_);
    }

private:
    void fill_columns()
    {
        origin_ = {median<0>(), median<1>(), median<2>()};
        columns_ = fill_light_columns(lights_, origin_, storage_);
        luminance_ = storage_.data() + (columns_.luminance_radius.data() - storage_.data());
    }
    template <int axis> double median() const
    {
        if (lights_.empty()) return 0;
        std::vector<double> along;
        for (const Light& light : lights_) along.push_back(light.center[axis]);
        const auto middle = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
        std::nth_element(along.begin(), middle, along.end());
        return *middle;
    }

    Lights lights_;
    LightHierarchy hierarchy_;
    Policy policy_;
    Vec3<double> origin_{0};
    std::vector<T> storage_;
    LightColumns<T> columns_;
    T* luminance_ = nullptr;  ///< the column of Y(L)·r, in the storage
};

/// A shading point with the policy's table for it. Keep one per thread and move it from point to
/// point: it allocates when it is made, and when it is moved and there are more lights than ever
/// before.
template <class Policy, class T = float> class DirectPoint {
    using Table = decltype(std::declval<const Policy&>().template prepare<T>(
        std::declval<const ChoicePoint<T>&>(), std::declval<const LightColumns<T>&>(),
        std::declval<Scratch&>()));

public:
    /// Keeps a reference to the lights.
    explicit DirectPoint(const DirectLights<Policy, T>& lights)
        : lights_(&lights), scratch_(scratch_bytes(lights))
    {
    }

    /// To position x (scene units) with unit normal n. O(M) for policies that look at all lights,
    /// O(log M) for the others (is x inside a light?). A position or normal that is not finite, and
    /// one inside a light, is not lit.
    /// wo (unit, scene axes) and bsdf are for policies that look at them (`product`); without, such
    /// a policy takes the surface for Lambertian.
    void move_to(const Vec3<double>& x, const Vec3<T>& n, const Vec3<T>& wo = {0, 0, 1},
                 const AnyBsdf& bsdf = {})
    {
        x_ = x, n_ = n;
        const bool is_finite = std::isfinite(x.x + x.y + x.z) && std::isfinite(n.x + n.y + n.z);
        is_lit_ = is_finite && !lights_->hierarchy().contains(x);
        const std::size_t needed = scratch_bytes(*lights_);
        if (scratch_.size() < needed) scratch_ = Scratch(needed);
        scratch_.clear();
        if (is_lit_)
            table_.emplace(lights_->policy().template prepare<T>(
                {vec_cast<T>(x - lights_->origin()), n, frame_around(n).to_local(wo), bsdf,
                 lights_->origin()},
                lights_->columns(), scratch_));
    }

    /// What it was made among.
    const DirectLights<Policy, T>& lights() const { return *lights_; }
    /// Its position, scene units.
    const Vec3<double>& x() const { return x_; }
    /// Its unit normal.
    const Vec3<T>& n() const { return n_; }
    /// Can any light reach it? See move_to().
    bool is_lit() const { return is_lit_; }

    /// A light drawn by 64 random bits, and its probability; no_light and 0 where none can
    /// contribute.
    Choice choose(std::uint64_t bits) const
    {
        return is_lit_ ? table_->choose(bits) : Choice{no_light, 0};
    }
    /// That of choose() drawing light j; for `all`, 1.
    double probability(LightIndex j) const { return is_lit_ ? table_->probability(j) : 0; }

    /// The cap that light j covers. A point that rounding puts onto the light sees a hemisphere.
    Cap<T> cap(LightIndex j) const
    {
        const Light& light = (*lights_).lights()[static_cast<std::size_t>(j)];
        const Vec3<double> to_center = light.center - x_;
        const double gap2 = length2(to_center) - light.radius * light.radius;
        return cap_towards(vec_cast<T>(to_center), static_cast<T>(light.radius),
                           max_of(static_cast<T>(gap2), T(1e-37)));
    }

private:
    static std::size_t scratch_bytes(const DirectLights<Policy, T>& lights)
    {
        return Policy::table_bytes(lights.lights().size()) + 64;
    }
    const DirectLights<Policy, T>* lights_;
    Scratch scratch_;
    std::optional<Table> table_;
    Vec3<double> x_{0};
    Vec3<T> n_{0, 0, 1};
    bool is_lit_ = false;
};

}  // namespace mis
