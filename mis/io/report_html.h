#pragma once

#include "mis/io/page_pictures.h"
#include "mis/report/report.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mis {

/// The report as one page of HTML that asks for nothing but itself: style, script and d3 stand in
/// it (mis/io/report_html/), figures as report_json() gives them, pictures as base64.
/// pictures: one per scene; nothing for a scene without a camera.
std::string report_html(const Report& report,
                        std::span<const std::optional<PagePictures>> pictures);

/// Writes it to the file `path`, whole or not at all. Throws WriteError.
void write_report_html(const Report& report, std::span<const std::optional<PagePictures>> pictures,
                       const std::string& path);

/// JSON that may stand between <script> tags: what HTML or JavaScript would take for its own is
/// written as \u escapes, which mean the same.
std::string json_for_html(std::string_view json);

}  // namespace mis
