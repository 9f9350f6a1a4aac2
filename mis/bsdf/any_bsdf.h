#pragma once

#include "mis/bsdf/registry.h"
#include "mis/math/type_list.h"
#include "mis/scene/material.h"
#include "mis/scene/named.h"

#include <memory>
#include <string_view>
#include <type_traits>

namespace mis {

namespace detail {
template <class... Bs> Distinct<FormulaOf<Bs>...> formulas_of(TypeList<Bs...>);
}
/// The formulas of the registered BSDFs.
using BsdfFormulas = decltype(detail::formulas_of(Bsdfs{}));

/// A BSDF whose type is known at run time alone: its formula, and the number of that. A view;
/// kernels visit it without a virtual call.
struct AnyBsdf {
    const void* object = nullptr;  ///< nullptr: nothing is known of the surface
    int type = -1;                 ///< bsdf_number() of its name

    /// f(formula), with the type that it has; nothing where there is none.
    template <class F> MIS_INLINE void visit(F&& f) const
    {
        int number = 0;
        for_each_type(
            BsdfFormulas{}, [&]<class B>() __attribute__((always_inline)) {
                if (number++ == type) f(*static_cast<const B*>(object));
            });
    }
};

/// Has it no lobe beside its diffuse part?
inline bool is_diffuse(const AnyBsdf& bsdf)
{
    bool is = false;
    bsdf.visit([&](const auto& formula) { is = formula.is_diffuse(); });
    return is;
}

/// The number of the formula of a type of BSDF; −1 for a name that is not in the registry.
inline int bsdf_number(std::string_view name)
{
    int found = -1;
    visit_named(Bsdfs{}, name, [&]<class B>() {
        int number = 0;
        for_each_type(BsdfFormulas{}, [&]<class F>() {
            if (std::is_same_v<F, FormulaOf<B>>) found = number;
            ++number;
        });
    });
    return found;
}

/// A view of a BSDF.
template <class B> AnyBsdf any_bsdf(const B& bsdf)
{
    const FormulaOf<B>& formula = bsdf;
    return {&formula, bsdf_number(B::name)};
}

/// The formula of a material's BSDF. Throws std::out_of_range for a type that is not in the
/// registry.
inline std::shared_ptr<const void> make_bsdf(const Material& material)
{
    return require_named(Bsdfs{}, "BSDF", material.type,
                         [&]<class B>() -> std::shared_ptr<const void> {
                             return std::make_shared<const FormulaOf<B>>(B(material));
                         });
}

/// The lobe of a material alone, of which all draws are the lobe's: f is the whole f without its
/// diffuse part. nullptr where there is no lobe.
inline std::shared_ptr<const void> make_lobe(Material material)
{
    const std::shared_ptr<const void> whole = make_bsdf(material);
    if (is_diffuse({whole.get(), bsdf_number(material.type)})) return nullptr;
    material.diffuse = Vec3<double>(0);
    material.specular_probability = 1;
    return make_bsdf(material);
}

}  // namespace mis
