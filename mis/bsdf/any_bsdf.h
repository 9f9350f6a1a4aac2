#pragma once

#include "mis/bsdf/registry.h"
#include "mis/math/type_list.h"
#include "mis/scene/material.h"
#include "mis/scene/raise.h"

#include <memory>
#include <stdexcept>
#include <string_view>

namespace mis {

/// A BSDF whose type is known at run time alone: an object, and the number of its type in the
/// registry. A view; kernels visit it without a virtual call.
struct AnyBsdf {
    const void* object = nullptr;  ///< nullptr: nothing is known of the surface
    int type = -1;                 ///< bsdf_number() of its name

    /// f(bsdf), with the type that it has; nothing where there is none.
    template <class F> MIS_INLINE void visit(F&& f) const
    {
        int number = 0;
        for_each_type(
            Bsdfs{}, [&]<class B>() __attribute__((always_inline)) {
                if (number++ == type) f(*static_cast<const B*>(object));
            });
    }
};

/// The number of a type of BSDF in the registry; −1 for a name that is not there.
inline int bsdf_number(std::string_view name)
{
    int found = -1, number = 0;
    for_each_type(Bsdfs{}, [&]<class B>() {
        if (B::name == name) found = number;
        ++number;
    });
    return found;
}

/// A view of a BSDF.
template <class B> AnyBsdf any_bsdf(const B& bsdf) { return {&bsdf, bsdf_number(B::name)}; }

/// The BSDF of a material, by its type: an object of that type. Throws std::out_of_range for a type
/// that is not in the registry.
inline std::shared_ptr<const void> make_bsdf(const Material& material)
{
    std::shared_ptr<const void> bsdf;
    for_each_type(Bsdfs{}, [&]<class B>() {
        if (B::name == material.type) bsdf = std::make_shared<const B>(material);
    });
    if (!bsdf) raise<std::out_of_range>("no BSDF is called " + material.type);
    return bsdf;
}

}  // namespace mis
