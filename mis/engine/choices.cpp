#include "mis/engine/choices.h"

#include "mis/policy/registry.h"
#include "mis/scene/named.h"

#include <type_traits>

namespace mis {

std::shared_ptr<const void> make_policy(std::string_view name, const Lights& lights,
                                        const StopToken& stop)
{
    stop.check();
    return require_named(Policies{}, "policy", name, [&]<class P>() -> std::shared_ptr<const void> {
        if constexpr (std::is_constructible_v<P, const Lights&, const StopToken&>)
            return std::make_shared<const P>(lights, stop);
        else return std::make_shared<const P>(lights);
    });
}

}  // namespace mis
