#pragma once

#include "mis/engine/draw.h"
#include "mis/engine/light_columns.h"
#include "mis/engine/radiance_scale.h"
#include "mis/engine/union_draw.h"
#include "mis/trace/lights.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace mis {

/// The lights of a host's scene, made ready for one policy at a time: the hierarchy over them, the
/// policy's own tables, and the columns it reads. Allocates when it is made and when lights change
/// that its tables are of, never between. Many threads may read it.
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

    /// Another light in the place of light j: moved, of another radius or radiance. O(log M) for
    /// the hierarchy, and for the policy what docs/embedding.md says: its tables are made anew only
    /// where this light is in them. origin() stays. Points made before are prepared again by
    /// move_to.
    void replace(LightIndex j, const Light& light)
    {
        assert(j >= 0 && static_cast<std::size_t>(j) < lights_.size() && "j: an index of a light");
        const auto i = static_cast<std::size_t>(j);
        const Light before = std::exchange(lights_[i], light);
        if (before.center != light.center || before.radius != light.radius)
            hierarchy_.refit(j, before);
        const Vec3<T> center = vec_cast<T>(light.center - origin_);
        cell(columns_.x, i) = center.x, cell(columns_.y, i) = center.y;
        cell(columns_.z, i) = center.z;
        cell(columns_.radius, i) = static_cast<T>(light.radius);
        cell(columns_.luminance_radius, i) = static_cast<T>(luminance_radius(light) * scale_);
        note_radius(before.radius, light.radius);
        note_brightness(luminance_radius(before), luminance_radius(light));
        if (!keeps_tables<Policy>(before, light)) policy_ = Policy(lights_);
    }

    /// Another radiance for light j, W·sr⁻¹·m⁻², with the sphere as it is.
    void recolor(LightIndex j, const Vec3<double>& radiance)
    {
        assert(j >= 0 && static_cast<std::size_t>(j) < lights_.size() && "j: an index of a light");
        const Light& light = lights_[static_cast<std::size_t>(j)];
        replace(j, make_light(light.center, light.radius, radiance));
    }

private:
    void fill_columns()
    {
        origin_ = {median<0>(), median<1>(), median<2>()};
        brightest_ = brightest();
        scale_ = radiance_scale(brightest_);
        columns_ = fill_light_columns(lights_, origin_, storage_, nullptr, scale_);
        largest_radius_ = largest_radius();
    }
    /// A number of a column, to be written.
    T& cell(std::span<const T> column, std::size_t j)
    {
        return storage_[static_cast<std::size_t>(column.data() - storage_.data()) + j];
    }
    double largest_radius() const
    {
        double largest = 0;
        for (const Light& light : lights_) largest = std::max(largest, light.radius);
        return largest;
    }
    /// Looks at all radii only where the largest one shrinks.
    void note_radius(double before, double after)
    {
        if (after >= largest_radius_) largest_radius_ = after;
        else if (before == largest_radius_) largest_radius_ = largest_radius();
        columns_.inverse_largest_radius = static_cast<T>(1 / largest_radius_);
    }
    double brightest() const
    {
        double most = 0;
        for (const Light& light : lights_) most = std::max(most, luminance_radius(light));
        return most;
    }
    /// Looks at all lights only where the brightest one dims, and fills the columns anew only where
    /// their scale changes.
    void note_brightness(double before, double after)
    {
        if (after >= brightest_) brightest_ = after;
        else if (before == brightest_) brightest_ = brightest();
        if (radiance_scale(brightest_) == scale_) return;
        scale_ = radiance_scale(brightest_);
        columns_ = fill_light_columns(lights_, origin_, storage_, nullptr, scale_);
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
    LargeVector<T> storage_;
    LightColumns<T> columns_;
    double largest_radius_ = 0;
    double brightest_ = 0, scale_ = 1;  ///< of the luminances in the columns
};

/// A shading point amid lights: what of it does not depend on a policy.
template <class T> class PointAmidLights {
public:
    /// float or double.
    using Number = T;

    /// Its position, scene units.
    const Vec3<double>& x() const { return x_; }
    /// Its unit normal.
    const Vec3<T>& n() const { return n_; }
    /// Can any light reach it? See DirectPoint::move_to().
    bool is_lit() const { return is_lit_; }
    /// Are its position and normal numbers? A point that has not been moved anywhere counts as one.
    bool is_finite() const { return is_finite_; }

    /// How many lights there are.
    std::size_t light_count() const { return lights_->size(); }
    /// Light j.
    const Light& light(LightIndex j) const { return (*lights_)[static_cast<std::size_t>(j)]; }
    /// Which light does a ray meet?
    const LightHierarchy& hierarchy() const { return *hierarchy_; }

    /// The cap that light j covers. A point that rounding puts onto the light sees a hemisphere.
    Cap<T> cap(LightIndex j) const
    {
        const Vec3<double> to_center = light(j).center - x_;
        return cap_of_light(vec_cast<T>(to_center), static_cast<T>(light(j).radius),
                            static_cast<T>(gap2_of(to_center, light(j).radius)));
    }
    /// That of light j, steradians, in double.
    double solid_angle(LightIndex j) const { return solid_angle_from(x_, light(j)); }

protected:
    /// Keeps references to both.
    PointAmidLights(const Lights& lights, const LightHierarchy& hierarchy)
        : lights_(&lights), hierarchy_(&hierarchy)
    {
    }
    /// See DirectPoint::move_to().
    void move(const Vec3<double>& x, const Vec3<T>& n)
    {
        x_ = x, n_ = n;
        is_finite_ = std::isfinite(x.x + x.y + x.z) && std::isfinite(n.x + n.y + n.z);
        assert((!is_finite_ || std::abs(dot(n, n) - 1) < T(1e-3)) && "n: a unit vector");
        is_lit_ = is_finite_ && !hierarchy_->contains(x);
    }

private:
    const Lights* lights_;
    const LightHierarchy* hierarchy_;
    Vec3<double> x_{0};
    Vec3<T> n_{0, 0, 1};
    bool is_lit_ = false, is_finite_ = true;
};

/// A shading point with the policy's table for it. Keep one per thread and move it from point to
/// point: it allocates when it is made, and when it is moved and there are more lights than ever
/// before.
template <class Policy, class T = float> class DirectPoint : public PointAmidLights<T> {
    using Table = decltype(std::declval<const Policy&>().template prepare<T>(
        std::declval<const ChoicePoint<T>&>(), std::declval<const LightColumns<T>&>(),
        std::declval<Scratch&>()));

public:
    /// Keeps a reference to the lights.
    explicit DirectPoint(const DirectLights<Policy, T>& lights)
        : PointAmidLights<T>(lights.lights(), lights.hierarchy()), lights_(&lights),
          scratch_(scratch_bytes(lights))
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
        this->move(x, n);
        const std::size_t needed = scratch_bytes(*lights_);
        if (scratch_.size() < needed) scratch_ = Scratch(needed);
        scratch_.clear();
        if (this->is_lit())
            table_.emplace(lights_->policy().template prepare<T>(
                {vec_cast<T>(x - lights_->origin()), n, frame_around(n).to_local(wo), bsdf,
                 lights_->origin()},
                lights_->columns(), scratch_));
    }

    /// What it was made among.
    const DirectLights<Policy, T>& lights() const { return *lights_; }
    /// Is one sample a draw for every light (`all`)?
    static constexpr bool draws_every_light() { return Policy::draws_every_light; }

    /// A light drawn by 64 random bits, and its probability; no_light and 0 where none can
    /// contribute.
    Choice choose(std::uint64_t bits) const
    {
        return this->is_lit() ? table_->choose(bits) : Choice{no_light, 0};
    }
    /// That of choose() drawing light j; for `all`, 1.
    double probability(LightIndex j) const { return this->is_lit() ? table_->probability(j) : 0; }

private:
    static std::size_t scratch_bytes(const DirectLights<Policy, T>& lights)
    {
        return Policy::table_bytes(lights.lights().size()) + 64;
    }
    const DirectLights<Policy, T>* lights_;
    Scratch scratch_;
    std::optional<Table> table_;
};

/// A point under a policy that is known at run time alone: a view of a DirectPoint as it stands
/// now. What is compiled for it serves every policy.
template <class T> class AnyDirectPoint : public PointAmidLights<T> {
public:
    /// Keeps a reference to the point, for which it speaks until that moves.
    template <class Policy>
    explicit AnyDirectPoint(const DirectPoint<Policy, T>& point)
        : PointAmidLights<T>(point), point_(&point), draws_every_light_(point.draws_every_light()),
          choose_([](const void* p, std::uint64_t bits) {
              return static_cast<const DirectPoint<Policy, T>*>(p)->choose(bits);
          }),
          probability_([](const void* p, LightIndex j) {
              return static_cast<const DirectPoint<Policy, T>*>(p)->probability(j);
          })
    {
    }

    /// Is one sample a draw for every light (`all`)?
    bool draws_every_light() const { return draws_every_light_; }
    /// As DirectPoint::choose().
    Choice choose(std::uint64_t bits) const { return choose_(point_, bits); }
    /// As DirectPoint::probability().
    double probability(LightIndex j) const { return probability_(point_, j); }

private:
    const void* point_;
    bool draws_every_light_;
    Choice (*choose_)(const void*, std::uint64_t);
    double (*probability_)(const void*, LightIndex);
};

}  // namespace mis
