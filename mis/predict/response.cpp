#include "mis/predict/response.h"

#include "mis/bsdf/registry.h"
#include "mis/scene/named.h"

namespace mis {

Response::Response(const Material& material, const Vec3<double>& n, const Vec3<double>& wo)
    : frame_(frame_around(n)), wo_(wo), wo_local_(frame_.to_local(wo))
{
    using Evaluate = decltype(evaluate_);
    evaluate_ = require_named(Bsdfs{}, "BSDF", material.type, [&]<class B>() -> Evaluate {
        const B bsdf(material);
        draws_ = bsdf.draws();
        return [bsdf](const Vec3<double>& o, const Vec3<double>& i) { return bsdf.evaluate(o, i); };
    });
}

ResponseValue Response::at(const Vec3<double>& wi) const
{
    const Vec3<double> local = frame_.to_local(wi);
    if (!(local.z > 0)) return {};
    const BsdfValue<double> value = evaluate_(wo_local_, local);
    return {value.f, value.pdf, local.z};
}

}  // namespace mis
