#include "mis/io/random_lights.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mis {
namespace {

/// SplitMix64 (Steele, Lea and Flood 2014).
class SplitMix64 {
public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
    std::uint64_t operator()()
    {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }

private:
    std::uint64_t state_;
};

/// low + u (high − low), u from the top 53 bits.
double uniform_between(double low, double high, std::uint64_t bits)
{
    const double u = static_cast<double>(bits >> 11) * 0x1p-53;
    return std::min(low + u * (high - low), high);
}

/// low · (high/low)^u, u from the top 56 bits. The power is a product of square roots, one per set
/// bit of u, which are correctly rounded everywhere; exp and log are not, and would give another
/// scene on another machine.
class LogUniform {
public:
    explicit LogUniform(const std::array<double, 2>& range) : range_(range)
    {
        double root = std::sqrt(range[1]) /
                      std::sqrt(range[0]);  // ratio^(1/2); the ratio itself may overflow
        for (auto& byte : factors_) {
            byte[0] = 1;
            for (unsigned bit = 128; bit > 0; bit /= 2, root = std::sqrt(root)) byte[bit] = root;
            fill_combined(byte);
        }
    }

    double operator()(std::uint64_t bits) const
    {
        double value = range_[0];
        for (unsigned i = 0; i < factors_.size(); ++i)
            value *= factors_[i][(bits >> (56 - 8 * i)) & 255];
        return std::clamp(value, range_[0], range_[1]);
    }

private:
    /// Factors of single bits are known; every other byte is its highest bit's factor times the
    /// rest's.
    static void fill_combined(std::array<double, 256>& byte)
    {
        for (unsigned i = 1; i < 256; ++i) {
            const unsigned highest = std::bit_floor(i);
            if (i != highest) byte[i] = byte[highest] * byte[i - highest];
        }
    }

    std::array<double, 2> range_;
    std::array<std::array<double, 256>, 7> factors_;
};

}  // namespace

void append_random_lights(const RandomLights& lights, Lights& to, const StopToken& stop)
{
    SplitMix64 bits(lights.seed);
    const LogUniform radius(lights.radius), power(lights.power);
    const auto& [low, high] = lights.box;
    to.reserve(to.size() + lights.count);
    StopEvery check(stop, 1 << 14);
    for (std::size_t i = 0; i < lights.count; ++i) {
        check();
        const double x = uniform_between(low.x, high.x, bits());
        const double y = uniform_between(low.y, high.y, bits());
        const double z = uniform_between(low.z, high.z, bits());
        const double light_radius = radius(bits());
        to.push_back(make_light_of_power({x, y, z}, light_radius, Vec3<double>(power(bits()))));
    }
}

}  // namespace mis
