#include "mis/scene/named.h"

#include "mis/scene/nearest_name.h"

namespace mis {

std::string unknown_name(std::string_view what, std::string_view found,
                         std::span<const std::string_view> known)
{
    const std::string_view near = nearest_name(found, known);
    std::string text = std::string(what) + " \"" + std::string(found) + "\"; known are ";
    text += comma_list(known);
    if (!near.empty()) text += "\n    Did you mean \"" + std::string(near) + "\"?";
    return text;
}

}  // namespace mis
