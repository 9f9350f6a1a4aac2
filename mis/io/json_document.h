#pragma once

#include "mis/math/stop_token.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <string_view>

namespace mis {

using Json = nlohmann::json;

/// Told of each element of one list of the document as soon as it is complete; the document itself
/// keeps that list empty. So a list of millions never stands in memory as JSON. document: what has
/// been read so far.
using ElementSink =
    std::function<void(const Json& document, std::size_t index, const Json& element)>;

/// The document that `text` is: JSON with comments. Throws SceneError for what is no JSON (with
/// line and column), for a key given twice, a number that a double cannot hold, nesting past
/// limits::nesting, and bytes that are not UTF-8. The elements of the top-level list
/// `streamed_list` go to `sink`; an exception of the sink ends the reading, as Stopped does.
Json parse_json(std::string_view text, const std::filesystem::path& file,
                std::string_view streamed_list, const ElementSink& sink,
                const StopToken& stop = {});

}  // namespace mis
