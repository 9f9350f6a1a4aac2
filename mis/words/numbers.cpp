#include "mis/words/numbers.h"

#include "mis/report/run_head.h"
#include "mis/strategy/names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace mis {
namespace {

/// value, rounded to a digit that stands `digits` places right of the point (left if negative),
/// without an exponent.
std::string fixed(double value, int digits)
{
    const double unit = std::pow(10.0, -digits);
    const double rounded = digits < 0 ? std::round(value / unit) * unit : value;
    std::array<char, 400> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), rounded,
                                   std::chars_format::fixed, std::max(digits, 0));
    return {text.data(), end.ptr};
}

/// Decimal place of the first digit of |value|: 0 for 1 to 9.99, −1 for 0.1 …
int magnitude(double value) { return static_cast<int>(std::floor(std::log10(std::fabs(value)))); }

}  // namespace

std::string number(double value, int digits)
{
    if (std::isnan(value)) return "?";
    if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
    std::array<char, 64> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::general, digits);
    std::string text(buffer.data(), end.ptr);
    const std::size_t e = text.find('e');
    if (e == std::string::npos) return text;
    const int exponent = std::stoi(text.substr(e + 1));
    if (exponent > 0 && exponent < 6)
        return fixed(value, digits - 1 - exponent);  // "12000", not "1.2e4"
    return text.substr(0, e + 1) + std::to_string(exponent);
}

std::string count(double value)
{
    return std::isfinite(value) ? fixed(std::round(value), 0) : number(value);
}

std::string counted(double value, std::string_view what)
{
    return count(value) + " " + noun(count(value) == "1" ? 1 : 2, what);
}

std::string percent(double share) { return number(100 * share, 2) + " %"; }

std::string with_error(const Interval& interval)
{
    const double up = interval.high - interval.value, down = interval.value - interval.low,
                 error = std::max(up, down);
    if (!std::isfinite(interval.value) || !std::isfinite(up) || !std::isfinite(down) || error <= 0)
        return number(interval.value);
    if (error > 0.15 * std::fabs(interval.value))
        return number(interval.value, 2) + " (" + number(interval.low, 2) + " to " +
               number(interval.high, 2) + ")";
    const double unit = std::pow(10.0, magnitude(error));
    const double shown =
        std::ceil(error / unit * (1 - 1e-9)) * unit;  // one digit, never less than the error
    const int size = magnitude(interval.value), digits = -magnitude(shown);
    if (size > 5 || size < -3)
        return number(interval.value, std::max(1, size + digits + 1)) + " ± " + number(shown, 1);
    return fixed(interval.value, digits) + " ± " + fixed(shown, digits);
}

namespace {

struct Unit {
    double seconds;
    const char* name;
};

Unit unit_of(double seconds)
{
    if (seconds >= 36e5) return {86400, "days"};
    if (seconds >= 3600) return {3600, "h"};
    if (seconds >= 100) return {60, "min"};
    if (seconds >= 1 || seconds <= 0) return {1, "s"};
    if (seconds >= 1e-3) return {1e-3, "ms"};
    return {1e-6, "µs"};
}

}  // namespace

std::string duration(double seconds)
{
    if (!std::isfinite(seconds)) return number(seconds);
    const Unit unit = unit_of(seconds);
    return number(seconds / unit.seconds, 2) + " " + unit.name;
}

std::string duration(const Interval& seconds)
{
    if (!std::isfinite(seconds.low) || !std::isfinite(seconds.high)) return duration(seconds.value);
    const Unit unit = unit_of(seconds.value);
    const Interval scaled{seconds.value / unit.seconds, seconds.low / unit.seconds,
                          seconds.high / unit.seconds};
    return scaled.low < scaled.high ? with_error(scaled) + " " + unit.name
                                    : duration(seconds.value);
}

std::string listed(std::span<const std::string> names)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
        text += names[i];
    }
    return text;
}

const char* sampler_name(bool is_sobol) { return sampler_names[is_sobol]; }

std::string replay_words(const std::string& file, const Strategy& strategy,
                         const SampleName& sample)
{
    return "mis replay " + file + " --strategy " + name_of(strategy) + " --point " +
           std::to_string(sample.point) + " --sample " + std::to_string(sample.sample);
}

}  // namespace mis
