#pragma once

#include "mis/scene/light.h"
#include "mis/scene/material.h"

#include <memory>
#include <string_view>

namespace mis {

// The registered types by name, for pipelines that are composed at run time. The pointers hold an
// object of the type.

/// Throws std::out_of_range for an unknown name, as make_bsdf does.
std::shared_ptr<const void> make_policy(std::string_view name, const Lights& lights);

/// The BSDF of a material, by its type.
std::shared_ptr<const void> make_bsdf(const Material& material);

}  // namespace mis
