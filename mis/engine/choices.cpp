#include "mis/engine/choices.h"

#include "mis/policy/registry.h"
#include "mis/scene/raise.h"

#include <stdexcept>
#include <string>
#include <type_traits>

namespace mis {

std::shared_ptr<const void> make_policy(std::string_view name, const Lights& lights,
                                        const StopToken& stop)
{
    stop.check();
    std::shared_ptr<const void> policy;
    for_each_type(Policies{}, [&]<class P>() {
        if (P::name != name) return;
        if constexpr (std::is_constructible_v<P, const Lights&, const StopToken&>)
            policy = std::make_shared<const P>(lights, stop);
        else policy = std::make_shared<const P>(lights);
    });
    if (!policy) raise<std::out_of_range>("no policy is called " + std::string(name));
    return policy;
}

}  // namespace mis
