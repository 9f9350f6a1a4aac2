#include "mis/io/report_json.h"

#include "mis/io/atomic_file.h"
#include "mis/io/json_writer.h"

namespace mis {

std::string report_json(const Report& report) { return json_text(described_json(report)); }

void write_report_json(const Report& report, const std::string& path)
{
    write_text(path, report_json(report));
}

}  // namespace mis
