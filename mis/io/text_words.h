#pragma once

#include <algorithm>
#include <string_view>

namespace mis {

/// A blank of a text file, or an end of a line.
inline bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Takes the next word off the front of `rest`, with the blanks before it; empty at the end.
inline std::string_view take_word(std::string_view& rest)
{
    const auto begin = std::find_if_not(rest.begin(), rest.end(), is_blank);
    const auto end = std::find_if(begin, rest.end(), is_blank);
    const std::string_view word(begin, end);
    rest.remove_prefix(static_cast<std::size_t>(end - rest.begin()));
    return word;
}

}  // namespace mis
