#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace mis::bench {

/// The middle half of some repetitions: quartiles and median. NaN where there are none.
struct Middle {
    double low = std::numeric_limits<double>::quiet_NaN(), median = low, high = low;

    bool is_known() const { return std::isfinite(median); }
    friend Middle operator*(double factor, const Middle& m)
    {
        return {factor * m.low, factor * m.median, factor * m.high};
    }
    friend Middle operator+(const Middle& a, const Middle& b)
    {
        return {a.low + b.low, a.median + b.median, a.high + b.high};
    }
    friend Middle operator-(const Middle& a, const Middle& b)
    {
        return {a.low - b.high, a.median - b.median, a.high - b.low};
    }
    /// Of medians; the interval is as wide as both can make it.
    friend Middle operator/(const Middle& a, const Middle& b)
    {
        return {a.low / b.high, a.median / b.median, a.high / b.low};
    }
};

/// A number that does not vary.
inline Middle exactly(double value) { return {value, value, value}; }

inline Middle middle_of(std::vector<double> values)
{
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const std::size_t above = std::min(below + 1, values.size() - 1);
        return std::lerp(values[below], values[above], place - std::floor(place));
    };
    return {at(0.25), at(0.5), at(0.75)};
}

/// What was measured: of each benchmark each counter, one number per repetition.
class Figures {
public:
    using Counters = std::map<std::string, std::vector<double>>;

    void add(const std::string& benchmark, const std::string& counter, double value)
    {
        all_[benchmark][counter].push_back(value);
    }
    /// Nothing known where it was not run.
    Middle at(const std::string& benchmark, const std::string& counter) const
    {
        const auto found = all_.find(benchmark);
        if (found == all_.end()) return {};
        const auto values = found->second.find(counter);
        return values == found->second.end() ? Middle{} : middle_of(values->second);
    }
    const std::map<std::string, Counters>& all() const { return all_; }

private:
    std::map<std::string, Counters> all_;
};

/// One thing that must hold, as it was measured.
struct Bar {
    int number;  ///< 1 to 8: docs/performance.md
    std::string what;
    Middle value;
    enum class Sense { at_most, at_least, report } sense;
    double limit = 0;
    std::string remark{};

    bool is_reached() const
    {
        return sense == Sense::report ||
               (sense == Sense::at_most ? value.median <= limit : value.median >= limit);
    }
};
using Bars = std::vector<Bar>;

}  // namespace mis::bench
