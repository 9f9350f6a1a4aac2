#pragma once

#include "mis/scene/material.h"
#include "mis/scene/named.h"

#include <array>
#include <span>
#include <string_view>

namespace mis {

/// What numbers a field of a material may hold.
enum class FieldRange { zero_to_one, not_negative, above_zero_to_one };

/// One field of a material in the scene file, and the member of Material that keeps it: a colour,
/// or a number.
struct MaterialField {
    std::string_view name;
    FieldRange range;
    Vec3<double> Material::*color = nullptr;
    double Material::*number = nullptr;
    bool required = true;  ///< one that is left out is 0
};

/// A BSDF as the scene file sees it.
struct MaterialType {
    std::string_view name;  ///< as in the BSDF registry
    std::span<const MaterialField> fields;
    bool has_two_lobes = true;  ///< so that "specular_probability" means something
};

namespace material_fields {
using enum FieldRange;
inline constexpr std::array lambert{MaterialField{"albedo", zero_to_one, &Material::diffuse}};
inline constexpr std::array lecture{MaterialField{"kd", not_negative, &Material::diffuse},
                                    MaterialField{"ks", not_negative, &Material::specular},
                                    MaterialField{"m", not_negative, nullptr, &Material::exponent}};
inline constexpr std::array blinn{
    MaterialField{"diffuse", zero_to_one, &Material::diffuse},
    MaterialField{"specular", zero_to_one, &Material::specular},
    MaterialField{"exponent", not_negative, nullptr, &Material::exponent}};
inline constexpr std::array ggx{
    MaterialField{"diffuse", zero_to_one, &Material::diffuse, nullptr, false},
    MaterialField{"f0", zero_to_one, &Material::specular},
    MaterialField{"alpha", above_zero_to_one, nullptr, &Material::alpha}};
}  // namespace material_fields

/// Every type of material, and what it reads: the reader, the rules and docs/scene.schema.json
/// follow from this list.
inline constexpr std::array material_types{
    MaterialType{"lambert", material_fields::lambert, false},
    MaterialType{"lecture", material_fields::lecture},
    MaterialType{"blinn", material_fields::blinn},
    MaterialType{"ggx", material_fields::ggx},
};

static_assert(
    [] {
        for (const MaterialType& type : material_types)
            for (const MaterialField& field : type.fields)
                if ((field.color == nullptr) == (field.number == nullptr)) return false;
        return true;
    }(),
    "a field is a colour or a number");

inline constexpr auto material_type_names = [] {
    std::array<std::string_view, material_types.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = material_types[i].name;
    return names;
}();

/// The entry of that name; null if there is none.
inline constexpr const MaterialType* find_material_type(std::string_view name)
{
    return find_named(material_types, name);
}

}  // namespace mis
