#include "mis/scene/text.h"

#include <array>
#include <charconv>

namespace mis {
namespace {

template <class Number> std::string shortest(Number number)
{
    std::array<char, 32> buffer;  // a double takes 24 at most
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
    return {buffer.data(), end};
}

}  // namespace

std::string to_text(double number) { return shortest(number); }
std::string to_text(int number) { return shortest(number); }
std::string to_text(std::size_t number) { return shortest(number); }

std::string to_text(const Vec3<double>& v)
{
    return "[" + to_text(v.x) + ", " + to_text(v.y) + ", " + to_text(v.z) + "]";
}

std::string noun(std::size_t count, std::string_view what)
{
    const std::string one(what);
    if (count == 1) return one;
    const auto without = [&](std::size_t letters) { return one.substr(0, one.size() - letters); };
    if (what.ends_with("ex")) return without(2) + "ices";
    const bool is_y = what.size() > 1 && what.ends_with('y') &&
                      std::string_view("aeiou").find(what[what.size() - 2]) == what.npos;
    if (is_y) return without(1) + "ies";
    return one + (what.ends_with("sh") || what.ends_with('s') ? "es" : "s");
}

std::string many(std::size_t count, std::string_view what)
{
    return to_text(count) + " " + noun(count, what);
}

std::string pointer_token(std::string_view name)
{
    std::string token;
    for (const char c : name) {
        if (c == '~') token += "~0";
        else if (c == '/') token += "~1";
        else token += c;
    }
    return token;
}

}  // namespace mis
