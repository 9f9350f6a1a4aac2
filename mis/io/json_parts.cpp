#include "mis/io/json_parts.h"

#include <cmath>

namespace mis {

OrderedJson json_figure(double value)
{
    return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

OrderedJson json_text_or_null(const std::string& text)
{
    return text.empty() ? OrderedJson(nullptr) : OrderedJson(text);
}

OrderedJson json_interval(const Interval& x)
{
    return {{"value", json_figure(x.value)},
            {"low", json_figure(x.low)},
            {"high", json_figure(x.high)}};
}

OrderedJson json_resolution(int width, int height)
{
    return width > 0 ? OrderedJson{width, height} : OrderedJson(nullptr);
}

void put_setup(OrderedJson& json, const std::optional<SetupSeconds>& setup)
{
    if (!setup) return;
    json["setup_seconds"] = {{"reading", json_figure(setup->reading)},
                             {"surfaces", json_figure(setup->surfaces)},
                             {"lights", json_figure(setup->lights)}};
}

OrderedJson json_identity(const Strategy& s)
{
    return {{"name", name_of(s)},
            {"policy", json_text_or_null(s.policy)},
            {"heuristic", json_text_or_null(s.heuristic)},
            {"technique", s.technique},
            {"model", s.model == Model::multi ? "multi" : "one-sample"},
            {"counts", s.chooses_light() ? s.heuristic == "light" ? OrderedJson{s.counts[0], 0}
                                                                  : OrderedJson(s.counts)
                                         : OrderedJson{0, 1}}};
}

std::string json_text(const OrderedJson& json)
{
    return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace mis
