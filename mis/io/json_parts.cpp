#include "mis/io/json_parts.h"

#include "mis/words/numbers.h"

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

OrderedJson json_head(std::string_view format, const RunHead& run)
{
    return {{"format", format},
            {"version", run.version},
            {"command", run.command},
            {"seed", run.seed},
            {"sampler", sampler_name(run.is_sobol)},
            {"threads", run.threads},
            {"machine", run.machine},
            {"instruction_set", run.instruction_set},
            {"partial", run.partial}};
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
