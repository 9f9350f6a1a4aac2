#pragma once

#include "mis/report/report.h"
#include "mis/sampling/sample_name.h"
#include "mis/scene/text.h"

#include <span>
#include <string>
#include <string_view>

namespace mis {

// Numbers and lists as they stand in sentences. The same text for the same number on every machine.

/// So many significant digits, without trailing zeros: "0.0123", "1.2e-05" is "1.2e-5".
std::string number(double value, int digits = 3);

/// A count: "1048576", rounded to whole.
std::string count(double value);

/// "1 sample", "256 samples".
std::string counted(double value, std::string_view what);

/// "12 %", "0.3 %".
std::string percent(double share);

/// "3.4 ± 0.2", "3.4 (2.9 to 4.1)" where the interval is lopsided; "3.4" where none is known.
std::string with_error(const Interval& interval);

/// "0.83 s", "12 ms", "3 min", "2.5 h".
std::string duration(double seconds);

/// "0.83 ± 0.02 s", "8 (5 to 13) s".
std::string duration(const Interval& seconds);

/// "a", "a and b", "a, b and c".
std::string listed(std::span<const std::string> names);

/// As --sampler takes it.
const char* sampler_name(bool is_sobol);

/// The command that shows a sample again: "mis replay FILE --strategy NAME --point N --sample N".
std::string replay_words(const std::string& file, const Strategy& strategy,
                         const SampleName& sample);

}  // namespace mis
