#pragma once

#include "mis/math/vec.h"

#include <string>
#include <string_view>

namespace mis {

/// The shortest text that reads back as `number`: "0.1", "1e-30", "nan".
std::string to_text(double number);
std::string to_text(int number);
std::string to_text(std::size_t number);

/// "[1, 2, 3]".
std::string to_text(const Vec3<double>& v);

/// "light" of one, "lights" of others; "strategies", "meshes", "vertices".
std::string noun(std::size_t count, std::string_view what);

/// "1 light", "5 lights".
std::string many(std::size_t count, std::string_view what);

/// A name as one token of a JSON pointer (RFC 6901): ~ is written ~0, and / is written ~1.
std::string pointer_token(std::string_view name);

}  // namespace mis
