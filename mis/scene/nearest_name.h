#pragma once

#include <span>
#include <string>
#include <string_view>

namespace mis {

/// The name that was probably meant by `typed`: the nearest by edit distance (insert, delete,
/// replace, swap neighbours; capitals and leading dashes do not count) if at most a third of the
/// letters is wrong. Else the only one that begins so, or that `typed` begins with; empty if there
/// is none. A tie goes to the first.
std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known);

/// `Did you mean "lambert"?`, or `otherwise` where no known name is near.
std::string did_you_mean(std::string_view typed, std::span<const std::string_view> known,
                         std::string_view otherwise);

/// "a, b, c"; of more than twenty, the first, and how many more.
std::string comma_list(std::span<const std::string_view> names);

}  // namespace mis
