#include "mis/predict/choices.h"

#include "mis/bsdf/any_bsdf.h"
#include "mis/math/frame.h"
#include "mis/policy/registry.h"
#include "mis/scene/named.h"
#include "mis/technique/registry.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace mis {

namespace {

/// The lights' columns about the probe, as LightColumns wants them: padded, in double.
class ProbeColumns {
public:
    ProbeColumns(const Lights& lights, const Vec3<double>& origin) : count_(lights.size())
    {
        const std::size_t padded = (count_ + 15) / 16 * 16;
        for (auto& column : columns_) column.assign(padded, 1);
        for (std::size_t j = 0; j < count_; ++j) {
            const Vec3<double> center = lights[j].center - origin;
            columns_[0][j] = center.x, columns_[1][j] = center.y, columns_[2][j] = center.z;
            columns_[3][j] = lights[j].radius, columns_[4][j] = luminance_radius(lights[j]);
            largest_ = std::max(largest_, lights[j].radius);
        }
    }
    LightColumns<double> view() const
    {
        LightColumns<double> view;
        view.count = count_;
        view.x = columns_[0], view.y = columns_[1], view.z = columns_[2];
        view.radius = columns_[3], view.luminance_radius = columns_[4];
        view.inverse_largest_radius = 1 / largest_;
        return view;
    }

private:
    std::size_t count_;
    std::array<std::vector<double>, 5> columns_;
    double largest_ = 0;
};

/// Tables may hold floats, whose sum is 1 to rounding alone.
void normalize(std::vector<double>& probability)
{
    const double sum = std::accumulate(probability.begin(), probability.end(), 0.0);
    if (sum > 0)
        for (double& p : probability) p /= sum;
}

template <class P> PolicyView view_of(const Scene& scene, const Probe& probe)
{
    const std::size_t count = scene.lights.size();
    PolicyView view{.probability = std::vector<double>(count, 0),
                    .draws_every_light = P::draws_every_light};
    if (count == 0) return view;
    const P policy(scene.lights);
    const ProbeColumns columns(scene.lights, probe.position);
    Scratch scratch(P::table_bytes(count) + 64);
    ChoicePoint<double> point{};
    point.x = Vec3<double>(0), point.n = probe.normal, point.origin = probe.position;
    point.wo = frame_around(probe.normal).to_local(probe.outgoing);
    const Material& material = scene.materials[static_cast<std::size_t>(probe.material)];
    const std::shared_ptr<const void> bsdf = make_bsdf(material);
    point.bsdf = {bsdf.get(), bsdf_number(material.type)};
    const auto table = policy.template prepare<double>(point, columns.view(), scratch);
    for (std::size_t j = 0; j < count; ++j)
        view.probability[j] = table.probability(static_cast<LightIndex>(j));
    if (!P::draws_every_light) normalize(view.probability);
    return view;
}

}  // namespace

PolicyView policy_at(std::string_view policy, const Scene& scene, const Probe& probe)
{
    return require_named(Policies{}, "policy", policy,
                         [&]<class P>() { return view_of<P>(scene, probe); });
}

bool LightTechniqueView::keeps_above(const Ball& ball, const Vec3<double>& n) const
{
    return is_above(ball, n) ||
           (!is_below(ball, n) && !(pdf(ball.cap, n, -0.5 * ball.sin_max) > 0));
}

LightTechniqueView light_technique(std::string_view technique)
{
    const auto view_of_it = []<class K>() {
        LightTechniqueView view;
        if constexpr (K::chooses_light)
            view = {K::sums_lights, [](const Cap<double>& cap, const Vec3<double>& n,
                                       double cos_theta) { return K::pdf(cap, n, cos_theta); }};
        return view;
    };
    const auto view = require_named(Techniques{}, "technique", technique, view_of_it);
    if (view.pdf == nullptr)
        throw std::out_of_range(std::string(technique) + " draws towards no light");
    return view;
}

DirectionPdf direction_technique(std::string_view technique)
{
    const auto pdf_of_it = []<class K>() -> DirectionPdf {
        if constexpr (K::chooses_light) return nullptr;
        else return [](double bsdf_pdf, const Vec3<double>& wi) { return K::pdf(bsdf_pdf, wi); };
    };
    const DirectionPdf pdf = require_named(Techniques{}, "technique", technique, pdf_of_it);
    if (pdf == nullptr) throw std::out_of_range(std::string(technique) + " draws towards a light");
    return pdf;
}

}  // namespace mis
