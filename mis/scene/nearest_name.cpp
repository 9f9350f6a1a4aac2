#include "mis/scene/nearest_name.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace mis {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Optimal string alignment distance (Boytsov 2011, §2.2).
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                                 lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        std::swap(before_last, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

}  // namespace

std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known)
{
    constexpr std::size_t longest = 64;  // what is longer is no misspelt name of ours
    if (typed.empty() || typed.size() > longest) return {};
    std::string_view nearest;
    std::size_t least =
        std::max<std::size_t>(1, typed.size() / 2) + 1;  // as much wrong as right: no offer
    for (const std::string_view name : known) {
        const std::size_t distance = edit_distance(typed, name);
        if (distance < least && distance < name.size()) least = distance, nearest = name;
    }
    if (nearest.empty() && typed.size() >= 3)  // or a name that was not written to its end
        for (const std::string_view name : known)
            if (edit_distance(typed, name.substr(0, typed.size())) == 0) {
                if (!nearest.empty()) return {};
                nearest = name;
            }
    return nearest;
}

std::string did_you_mean(std::string_view typed, std::span<const std::string_view> known,
                         std::string_view otherwise)
{
    const std::string_view nearest = nearest_name(typed, known);
    if (nearest.empty()) return std::string(otherwise);
    return "Did you mean \"" + std::string(nearest) + "\"?";
}

std::string comma_list(std::span<const std::string_view> names)
{
    constexpr std::size_t most = 20;
    std::string list;
    for (const std::string_view name : names.first(std::min(most, names.size()))) {
        if (!list.empty()) list += ", ";
        list += name;
    }
    if (names.size() > most) list += ", and " + std::to_string(names.size() - most) + " more";
    return list;
}

}  // namespace mis
