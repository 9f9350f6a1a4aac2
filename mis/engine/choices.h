#pragma once

#include "mis/scene/light.h"

#include <memory>
#include <string_view>

namespace mis {

/// A registered policy by name, for pipelines that are composed at run time: an object of its type.
/// Throws std::out_of_range for an unknown name.
std::shared_ptr<const void> make_policy(std::string_view name, const Lights& lights);

}  // namespace mis
