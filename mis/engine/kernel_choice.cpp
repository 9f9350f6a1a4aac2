#include "mis/engine/kernels.h"

#include "mis/math/raise.h"
#include "mis/scene/named.h"

#include <cstdlib>
#include <stdexcept>

namespace mis {

// One pair per instruction set that was compiled (engine/kernels.cpp). They fill what stands here,
// so that no constructor or destructor is compiled for more than the baseline.
#define MIS_DECLARE_KERNELS(isa)            \
    void fill_float_##isa(Kernels<float>&); \
    void fill_double_##isa(Kernels<double>&);
MIS_DECLARE_KERNELS(scalar)
MIS_DECLARE_KERNELS(avx2)
MIS_DECLARE_KERNELS(avx512)
MIS_DECLARE_KERNELS(neon64)
#undef MIS_DECLARE_KERNELS

namespace {

struct InstructionSet {
    std::string_view name;
    const Kernels<float>& (*kernels_float)();
    const Kernels<double>& (*kernels_double)();
};

template <class T, void (*fill)(Kernels<T>&)> const Kernels<T>& filled()
{
    static const Kernels<T> kernels = [] {
        Kernels<T> empty{};
        fill(empty);
        return empty;
    }();
    return kernels;
}

/// Best first.
std::vector<InstructionSet> available()
{
    std::vector<InstructionSet> sets;
#if defined(MIS_HAS_AVX512)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd"))
        sets.push_back(
            {"avx512", filled<float, fill_float_avx512>, filled<double, fill_double_avx512>});
#endif
#if defined(MIS_HAS_AVX2)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        sets.push_back({"avx2", filled<float, fill_float_avx2>, filled<double, fill_double_avx2>});
#endif
#if defined(MIS_HAS_NEON64)
    sets.push_back(
        {"neon64", filled<float, fill_float_neon64>, filled<double, fill_double_neon64>});
#endif
    sets.push_back(
        {"scalar", filled<float, fill_float_scalar>, filled<double, fill_double_scalar>});
    return sets;
}

InstructionSet chosen(std::string_view name)
{
    const std::vector<InstructionSet> sets = available();
    if (name.empty()) return sets.front();
    if (const InstructionSet* set = find_named(sets, name)) return *set;
    raise<std::runtime_error>(unknown_name(
        "instruction set of this processor and this build: found", name, names_in(sets)));
}

}  // namespace

std::vector<std::string_view> instruction_sets() { return names_in(available()); }

template <> const Kernels<float>& kernels_of<float>(std::string_view name)
{
    return chosen(name).kernels_float();
}
template <> const Kernels<double>& kernels_of<double>(std::string_view name)
{
    return chosen(name).kernels_double();
}

namespace {
std::string_view wanted()
{
    const char* name = std::getenv("MIS_ISA");
    return name != nullptr ? name : "";
}
}  // namespace

template <> const Kernels<float>& kernels<float>() { return kernels_of<float>(wanted()); }
template <> const Kernels<double>& kernels<double>() { return kernels_of<double>(wanted()); }

}  // namespace mis
