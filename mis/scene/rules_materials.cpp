#include "mis/scene/rules.h"

#include "mis/scene/material_fields.h"
#include "mis/scene/nearest_name.h"
#include "mis/scene/text.h"

namespace mis {

namespace {

struct NamedRange {
    double low, high;
    std::string allowed;
};

NamedRange range_of(const MaterialField& field)
{
    const std::string name(field.name);
    if (field.range == FieldRange::zero_to_one) return {0, 1, name + " lies between 0 and 1"};
    if (field.range == FieldRange::above_zero_to_one)
        return {limits::min_alpha, 1,
                name + " is greater than 0 and at most 1; the smallest is " +
                    to_text(limits::min_alpha)};
    return {0, limits::material_number,
            name + " lies between 0 and " + to_text(limits::material_number)};
}

MaybeProblem check_field(const Material& material, const MaterialField& field)
{
    const NamedRange range = range_of(field);
    const auto holds = [&](double x) { return x >= range.low && x <= range.high; };
    const std::string pointer = "/" + std::string(field.name);
    const char* const remedy = "Write a number in this range.";
    if (field.color) {
        const Vec3<double>& color = material.*field.color;
        if (holds(color.x) && holds(color.y) && holds(color.z)) return {};
        const bool grey = color.x == color.y && color.y == color.z;
        return Problem{pointer, grey ? to_text(color.x) : to_text(color), range.allowed, remedy};
    }
    const double number = material.*field.number;
    if (holds(number)) return {};
    return Problem{pointer, to_text(number), range.allowed, remedy};
}

}  // namespace

MaybeProblem check_material(const Material& material)
{
    const MaterialType* const type = find_material_type(material.type);
    if (!type)
        return Problem{"/type", "\"" + material.type + "\"",
                       "known types are " + comma_list(material_type_names),
                       did_you_mean(material.type, material_type_names, "Use one of these.")};
    const auto fields = [&] {
        return first_problem_among(
            type->fields, StopToken(),
            [&](const MaterialField& f, std::size_t) { return check_field(material, f); });
    };
    const auto probability = [&]() -> MaybeProblem {
        const double s = material.specular_probability.value_or(0);
        if (!(s >= 0 && s <= 1))
            return Problem{"/specular_probability", to_text(s),
                           "a probability lies between 0 and 1",
                           "Leave it out for the type's own rule."};
        if (material.specular_probability && !type->has_two_lobes)
            return Problem{"/specular_probability", to_text(s),
                           material.type + " has no specular lobe", "Leave it out."};
        return {};
    };
    return first_problem(fields, probability);
}

}  // namespace mis
