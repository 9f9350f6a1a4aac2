#pragma once

#include "mis/scene/material_fields.h"

#include <array>
#include <string_view>
#include <vector>

namespace mis {

/// Every key of a scene file, object by object. The reader accepts these and no others, and a test
/// holds docs/scene.schema.json against them.
namespace scene_keys {

template <std::size_t count> using Names = std::array<std::string_view, count>;

inline constexpr std::string_view format = "mis-scene/1";

inline constexpr Names<8> scene{"$schema", "format",    "name",     "camera",
                                "probes",  "materials", "surfaces", "lights"};
inline constexpr Names<5> camera{"position", "target", "up", "vertical_fov", "resolution"};
inline constexpr Names<4> probe{"position", "normal", "outgoing", "material"};

inline constexpr Names<3> surface_types{"mesh", "sphere", "quad"};
inline constexpr Names<4> mesh{"type", "file", "material", "transform"};
inline constexpr Names<3> transform{"translate", "rotate", "scale"};
inline constexpr Names<4> sphere{"type", "center", "radius", "material"};
inline constexpr Names<4> quad{"type", "corner", "edges", "material"};

inline constexpr Names<3> light_types{"sphere", "table", "random"};
inline constexpr Names<5> light{"type", "center", "radius", "radiance", "power"};
inline constexpr Names<2> table{"type", "file"};
inline constexpr Names<6> random{"type", "count", "seed", "box", "radius", "power"};

/// The columns of a table of lights.
inline constexpr Names<7> columns{"x", "y", "z", "radius", "r", "g", "b"};

/// The keys of a material.
inline std::vector<std::string_view> material(const MaterialType& type)
{
    std::vector<std::string_view> keys{"type"};
    for (const MaterialField& field : type.fields) keys.push_back(field.name);
    if (type.has_two_lobes) keys.push_back("specular_probability");
    return keys;
}

}  // namespace scene_keys
}  // namespace mis
