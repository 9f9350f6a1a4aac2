#pragma once

#include "mis/bsdf/any_bsdf.h"
#include "mis/bsdf/bsdf.h"
#include "mis/math/cap.h"
#include "mis/policy/light_choice.h"
#include "mis/scene/scene.h"

#include <array>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace mis {

// The registered formulas in double, one point at a time, by name: for what checks the pipeline,
// not for what is timed.

/// A BSDF in the shading frame.
struct ScalarBsdf {
    std::function<BsdfValue<double>(const Vec3<double>& wo, const Vec3<double>& wi)> evaluate;
    std::function<Vec3<double>(const Vec3<double>& wo, double lobe, const Vec2<double>& u)> sample;
    bool draws = true;
    double lobe_share = 0;  ///< of the draws: those with `lobe` below it are the lobe's
};

/// Throws std::out_of_range for an unknown type.
ScalarBsdf scalar_bsdf(const Material& material);

/// A heuristic's weight of technique i (0: light, 1: BSDF), from the densities of both. Throws
/// std::out_of_range.
using ScalarHeuristic = std::function<double(const std::array<double, 2>& density, std::size_t i)>;
ScalarHeuristic scalar_heuristic(std::string_view name);

/// A technique, by what prices a direction: in the cap of one light, or over the hemisphere of the
/// shading frame.
struct ScalarTechnique {
    bool sums_lights = false;
    std::function<double(const Cap<double>&, const Vec3<double>& n, double cos_theta)> light_pdf;
    std::function<double(double bsdf_pdf, const Vec3<double>& wi)> direction_pdf;
};

/// Throws std::out_of_range for an unknown name.
ScalarTechnique scalar_technique(std::string_view name);

/// A policy; at() prepares a point. What it returns is good until the next call.
class ScalarPolicy {
public:
    struct Table {
        std::function<Choice(std::uint64_t bits)> choose;
        std::function<double(LightIndex)> probability;
    };
    /// made: make_policy(name, lights), where it is at hand. Throws std::out_of_range for an
    /// unknown name. Keeps a reference to the lights.
    ScalarPolicy(std::string_view name, const Lights& lights,
                 const std::shared_ptr<const void>& made = nullptr);
    /// wo: in the shading frame about n.
    const Table& at(const Vec3<double>& x, const Vec3<double>& n, const Vec3<double>& wo,
                    const AnyBsdf& bsdf);
    /// The same where the lights' columns are at hand; none are asked for unless
    /// reads_all_lights().
    const Table& at(const ChoicePoint<double>& point, const LightColumns<double>& columns);
    bool reads_all_lights() const { return reads_all_lights_; }
    /// Does a table differ from point to point, though it was made without a look at all lights? A
    /// probability then takes a walk.
    bool walks() const { return !reads_all_lights_ && has_tables_; }
    bool draws_every_light() const { return draws_every_light_; }

private:
    const Lights* lights_;
    bool draws_every_light_ = false, has_tables_ = false;
    std::function<Table(const ChoicePoint<double>&, const LightColumns<double>&, Scratch&)>
        prepare_;
    bool reads_all_lights_ = false;
    Scratch scratch_;
    LargeVector<double> columns_;
    Table table_;
};

}  // namespace mis
