#pragma once

#include "mis/math/stop_token.h"
#include "mis/scene/scene.h"

#include <optional>
#include <string>

namespace mis {

/// One broken rule of a scene, as scene/validate finds it; it knows no file.
struct Problem {
    std::string pointer;  ///< JSON pointer, RFC 6901
    std::string found;    ///< in words
    std::string allowed;  ///< in words
    std::string remedy;   ///< what to do
};

/// Limits of what one scene may hold; going past one is a Problem too. docs/scene-format.md states
/// them all.
namespace limits {
inline constexpr std::size_t lights = 10'000'000;     ///< of a scene
inline constexpr std::size_t triangles = 50'000'000;  ///< of a scene
inline constexpr int resolution = 16'384;             ///< pixels, of either side
inline constexpr std::size_t scene_file_bytes = std::size_t{1}
                                                << 30;  ///< of a table of lights, too
inline constexpr int nesting = 64;                      ///< of brackets and braces in a scene file
inline constexpr double length = 1e15;               ///< of a coordinate or a radius, scene units
inline constexpr double min_radius = 1e-30;          ///< of a light, scene units
inline constexpr double min_tangent = 1e-18;         ///< from a point to a light outside it: its
                                                     ///< square is still a float
inline constexpr double min_camera_tangent = 1e-15;  ///< from a camera: its points may be nearer
inline constexpr double min_radius_over_distance2 =
    1e-36;  ///< of a light as seen from a camera or probe; 1/scene units: weights are floats
inline constexpr double max_radiance_radius = 1e37;  ///< of a channel
inline constexpr double min_radiance_radius =
    1e-37;  ///< of a channel that is not black: a float holds it in full
inline constexpr double material_number = 1e9;  ///< of kd, ks and exponents
inline constexpr double min_alpha =
    1e-9;  ///< the lobe's peak 1/(π·alpha²), squared, is still a float
inline constexpr double min_sine =
    1e-9;  ///< between a camera's view and its up, and a quad's two edges
}  // namespace limits

/// The first rule that `scene` breaks, or nothing. Pointers name the place in a scene file that
/// would hold the value. The index in a pointer to a light is that in scene.lights. Throws Stopped.
std::optional<Problem> find_problem(const Scene& scene, const StopToken& stop = {});

/// How a scene file states what a light emits.
enum class Emission { radiance, power };

/// The rules of one light, before its colour goes to float: as stated in a file, `emitted` is a
/// radiance or a power. The Problem's pointer is relative to the light: "/center", "/radius",
/// "/radiance" or "/power".
std::optional<Problem> find_light_problem(const Vec3<double>& center, double radius,
                                          Emission emission, const Vec3<double>& emitted);

}  // namespace mis
