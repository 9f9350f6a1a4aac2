#include "mis/engine/choices.h"

#include "mis/policy/registry.h"
#include "mis/scene/named.h"

namespace mis {

std::shared_ptr<const void> make_policy(std::string_view name, const Lights& lights)
{
    return require_named(Policies{}, "policy", name, [&]<class P>() -> std::shared_ptr<const void> {
        return std::make_shared<const P>(lights);
    });
}

}  // namespace mis
