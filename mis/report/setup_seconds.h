#pragma once

#include "mis/report/field.h"

namespace mis {

/// Wall time before a study begins, which is no part of its `seconds`.
struct SetupSeconds {
    double reading = 0;   ///< the scene's files
    double surfaces = 0;  ///< Embree's tree
    double lights = 0;    ///< the hierarchy that rays ask for lights

    double all() const { return reading + surfaces + lights; }
};

template <class Visitor, Either<SetupSeconds> S> void describe(Visitor& v, S& setup)
{
    v.size(Field("reading", unit::wall_seconds), setup.reading);
    v.size(Field("surfaces", unit::wall_seconds), setup.surfaces);
    v.size(Field("lights", unit::wall_seconds), setup.lights);
}

}  // namespace mis
