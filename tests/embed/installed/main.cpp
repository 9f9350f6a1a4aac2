// A renderer that is not ours: headers of mis on its include path, the core linked, nothing else of
// mis at hand.
#include "mis/math/type_list.h"
#include "mis/policy/registry.h"
#include "mis/strategy/strategy.h"

#include <cstdio>

int main()
{
    bool all_known = true;
    mis::for_each_type(mis::Policies{}, [&]<class Policy>() {
        const mis::Strategy strategy = mis::parse_strategy(std::string(Policy::name) + "/balance");
        std::printf("%s\n", mis::name_of(strategy).c_str());
        all_known = all_known && strategy.policy == Policy::name;
    });
    return all_known ? 0 : 1;
}
