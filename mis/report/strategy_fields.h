#pragma once

#include "mis/report/field.h"
#include "mis/strategy/strategy.h"

#include <array>

namespace mis {

constexpr std::array<const char*, 3> names_of(Model) { return {"multi", "one-sample", "strata"}; }

/// Draws of one sample towards lights and of the BSDF, as files have them. Where no light is
/// chosen, or none is drawn of the BSDF, `counts` need not say so.
inline std::array<int, 2> draws_of(const Strategy& s)
{
    if (!s.chooses_light()) return {0, 1};
    return {s.counts[0], s.heuristic == "light" ? 0 : s.counts[1]};
}

/// A strategy as files have it. The name comes first, and follows from the others.
template <class Visitor, Either<Strategy> S> void describe(Visitor& v, S& s)
{
    v.strategy_name(Field("name").as("strategy"), s);
    v.text_or_null(Field("policy"), s.policy);
    v.text_or_null(Field("heuristic"), s.heuristic);
    v.text(Field("technique"), s.technique);
    v.one_of(Field("model"), s.model, names_of(s.model));
    v.draws(Field("counts"), s);
}

}  // namespace mis
