#pragma once

#include "mis/report/field.h"

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace mis {

/// RunHead::is_sobol as it stands in files: false, true.
inline constexpr std::array sampler_names{"independent", "sobol"};

/// What a report says of the run that made it.
struct RunHead {
    std::string version, command, machine, instruction_set;
    std::uint64_t seed = 1;
    bool is_sobol = false;  ///< scrambled sequences; else independent samples
    int threads = 1;
    bool partial = false;
};

/// Its fields, as a document of that format begins with them.
template <class Visitor, class S>
requires std::derived_from<S, RunHead>
void describe_run(Visitor& v, S& run, std::string_view format)
{
    v.format(Field("format"), format);
    v.text(Field("version"), run.version);
    v.text(Field("command"), run.command);
    v.count(Field("seed"), run.seed);
    v.one_of(Field("sampler").later(), run.is_sobol, sampler_names);
    v.count(Field("threads"), run.threads, 1);
    v.text(Field("machine"), run.machine);
    v.text(Field("instruction_set"), run.instruction_set);
    v.flag(Field("partial"), run.partial);
}

}  // namespace mis
