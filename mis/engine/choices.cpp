#include "mis/engine/choices.h"

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

}  // namespace mis
