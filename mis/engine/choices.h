#pragma once

#include "mis/math/stop_token.h"
#include "mis/scene/light.h"

#include <memory>
#include <string_view>

namespace mis {

/// A registered policy by name, for pipelines that are composed at run time: an object of its type.
/// A policy whose tables take long to make has a constructor that takes the token, too. Throws
/// std::out_of_range for an unknown name, and Stopped.
std::shared_ptr<const void> make_policy(std::string_view name, const Lights& lights,
                                        const StopToken& stop = {});

}  // namespace mis
