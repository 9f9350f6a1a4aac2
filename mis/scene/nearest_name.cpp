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

/// An option's name: what is typed before every one of them makes no two alike.
std::string_view without_dashes(std::string_view name)
{
    return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

/// How many letters may be wrong: a third of them.
std::size_t most_wrong(std::string_view typed)
{
    return std::max<std::size_t>(1, (typed.size() + 1) / 3);
}

/// Is one the beginning of the other, and long enough to tell?
bool goes_on(std::string_view typed, std::string_view name)
{
    const std::size_t shared = std::min(typed.size(), name.size());
    return shared >= 3 && edit_distance(typed.substr(0, shared), name.substr(0, shared)) == 0;
}

}  // namespace

std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known)
{
    constexpr std::size_t longest = 64;  // what is longer is no misspelt name of ours
    const std::string_view word = without_dashes(typed);
    if (word.empty() || word.size() > longest) return {};
    std::string_view nearest;
    std::size_t least = most_wrong(word) + 1;
    for (const std::string_view each : known) {
        const std::string_view name = without_dashes(each);
        const std::size_t distance = edit_distance(word, name);
        if (distance < least && distance < name.size()) least = distance, nearest = each;
    }
    if (!nearest.empty()) return nearest;
    for (const std::string_view each : known)  // or a name that was not written to its end
        if (goes_on(word, without_dashes(each))) {
            if (!nearest.empty()) return {};
            nearest = each;
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
