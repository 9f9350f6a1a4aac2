#include "mis/engine/choices.h"

#include "mis/bsdf/registry.h"
#include "mis/policy/registry.h"
#include "mis/scene/raise.h"

#include <stdexcept>
#include <string>

namespace mis {

std::shared_ptr<const void> make_policy(std::string_view name, const Lights& lights)
{
    std::shared_ptr<const void> policy;
    for_each_type(Policies{}, [&]<class P>() {
        if (P::name == name) policy = std::make_shared<const P>(lights);
    });
    if (!policy) raise<std::out_of_range>("no policy is called " + std::string(name));
    return policy;
}

std::shared_ptr<const void> make_bsdf(const Material& material)
{
    std::shared_ptr<const void> bsdf;
    for_each_type(Bsdfs{}, [&]<class B>() {
        if (B::name == material.type) bsdf = std::make_shared<const B>(material);
    });
    if (!bsdf) raise<std::out_of_range>("no BSDF is called " + material.type);
    return bsdf;
}

}  // namespace mis
