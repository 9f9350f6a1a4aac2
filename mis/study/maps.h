#pragma once

#include "mis/report/maps.h"
#include "mis/study/study.h"

namespace mis {

/// The maps of a study of a scene with a camera. at: samples per point that the efficiency is for.
Maps maps_of(const LitScene& scene, const Study& study, double at, const AnyExecutor& executor);

/// The memory that the maps of so many pixels and strategies take, bytes.
std::size_t maps_bytes(std::size_t pixels, std::size_t strategies);

}  // namespace mis
