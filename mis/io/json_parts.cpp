#include "mis/io/json_parts.h"

#include "mis/io/json_writer.h"

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
    OrderedJson json = OrderedJson::object();
    JsonWriter writer(json);
    describe_run(writer, run, format);
    return json;
}

void put_setup(OrderedJson& json, const std::optional<SetupSeconds>& setup)
{
    if (setup) json["setup_seconds"] = described_json(*setup);
}

OrderedJson json_identity(const Strategy& s) { return described_json(s); }

std::string json_text(const OrderedJson& json)
{
    return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace mis
