#include "mis/io/report_html.h"

#include "mis/io/atomic_file.h"
#include "mis/io/json_parts.h"
#include "mis/io/page_assets.h"
#include "mis/io/report_json.h"
#include "mis/strategy/names.h"

#include <fmt/format.h>

#include <array>
#include <random>

namespace mis {
namespace {

/// The page's script, in this order: each file uses what stands before it.
constexpr std::array script_files{"base.js",   "figures.js", "table.js",      "marks.js",
                                  "plot.js",   "dots.js",    "error_time.js", "stages.js",
                                  "decode.js", "colours.js", "viewer.js",     "pixel.js",
                                  "scenes.js", "honesty.js", "main.js"};

/// Scripts and styles run where they carry this number alone, which no scene's author can know.
std::string fresh_nonce()
{
    std::random_device device;
    return fmt::format("{:08x}{:08x}{:08x}{:08x}", device(), device(), device(), device());
}

/// What the parts of strategies' names mean, from the registries.
OrderedJson glossary()
{
    OrderedJson json;
    const auto add = [&json](const char* kind, const std::vector<Choosable>& names) {
        json[kind] = OrderedJson::object();
        for (const Choosable& c : names) json[kind][c.name] = c.summary;
    };
    add("policy", policy_names());
    add("heuristic", heuristic_names());
    add("technique", technique_names());
    return json;
}

std::string script()
{
    std::string text;
    for (const char* file : script_files) text += page_asset(file);
    return text;
}

std::string maps_json(std::span<const std::optional<PagePictures>> pictures)
{
    std::string json = "[";
    for (std::size_t i = 0; i < pictures.size(); ++i)
        json += (i == 0 ? "" : ",\n") + (pictures[i] ? pictures[i]->json : std::string("null"));
    return json + "]";
}

/// A block of data: the browser keeps it and runs nothing.
std::string data_block(std::string_view id, std::string_view type, std::string_view content)
{
    return fmt::format("<script type=\"{}\" id=\"{}\">{}</script>\n", type, id, content);
}

std::string figures_blocks(const Report& report,
                           std::span<const std::optional<PagePictures>> pictures)
{
    return data_block("report", "application/json", json_for_html(report_json(report))) +
           data_block("maps", "application/json", json_for_html(maps_json(pictures))) +
           data_block("glossary", "application/json", json_for_html(json_text(glossary())));
}

std::string picture_blocks(std::span<const std::optional<PagePictures>> pictures)
{
    std::string text;
    for (const std::optional<PagePictures>& scene : pictures)
        if (scene)
            for (const auto& [id, base64] : scene->pictures)
                text += data_block("picture-" + id, "text/plain", base64);
    return text;
}

}  // namespace

std::string json_for_html(std::string_view json)
{
    std::string text;
    text.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        // U+2028 and U+2029 end a line in old JavaScript; in UTF-8 E2 80 A8 and E2 80 A9.
        if (const std::string_view three = json.substr(i, 3);
            three == "\xE2\x80\xA8" || three == "\xE2\x80\xA9") {
            text += three.back() == '\xA8' ? "\\u2028" : "\\u2029";
            i += 2;
        } else if (c == '<' || c == '>' || c == '&') {
            text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        } else {
            text += c;
        }
    }
    return text;
}

std::string report_html(const Report& report, std::span<const std::optional<PagePictures>> pictures)
{
    const std::string_view page = page_asset("page.html");
    const std::string nonce = fresh_nonce();
    std::string text;
    for (std::size_t at = 0; at < page.size();) {
        const std::size_t begin = page.find("@@", at);
        text += page.substr(at, begin - at);
        if (begin == std::string_view::npos) break;
        const std::size_t end = page.find("@@", begin + 2);
        const std::string_view name = page.substr(begin + 2, end - begin - 2);
        if (name == "nonce") text += nonce;
        else if (name == "script") text += script();
        else if (name == "figures") text += figures_blocks(report, pictures);
        else if (name == "pictures") text += picture_blocks(pictures);
        else text += page_asset(name);
        at = end + 2;
    }
    return text;
}

void write_report_html(const Report& report, std::span<const std::optional<PagePictures>> pictures,
                       const std::string& path)
{
    write_text(path, report_html(report, pictures));
}

}  // namespace mis
