// Compiled once per instruction set (MIS_ISA), each time with the flags of that set. What stands
// here and in the stages' headers lives in an inline namespace of its own, so that no other code is
// ever linked to it but through the tables.
#include "mis/engine/kernels.h"

#include "mis/bsdf/registry.h"
#include "mis/engine/stages_bsdf.h"
#include "mis/engine/stages_light.h"
#include "mis/engine/stages_numbers.h"
#include "mis/engine/stages_screen.h"
#include "mis/engine/stages_strata.h"
#include "mis/engine/stages_sums.h"
#include "mis/heuristic/registry.h"
#include "mis/policy/registry.h"
#include "mis/technique/registry.h"

#include <new>

namespace mis {
inline namespace MIS_ISA {

namespace instruction_set {
#define MIS_TEXT_OF(x) #x
#define MIS_TEXT(x) MIS_TEXT_OF(x)
constexpr std::string_view name = MIS_TEXT(MIS_ISA);

template <class T> struct scalar {
    using Lanes = T;
};
#if !defined(MIS_WITHOUT_LANES)
template <class T> struct avx2 {
    using Lanes = xsimd::batch<T, xsimd::fma3<xsimd::avx2>>;
};
template <class T> struct avx512 {
    using Lanes = xsimd::batch<T, xsimd::avx512bw>;
};
template <class T> struct neon64 {
    using Lanes = xsimd::batch<T, xsimd::neon64>;
};
#endif
template <class T> using Lanes = typename MIS_ISA<T>::Lanes;
}  // namespace instruction_set

template <class Policy, class V, class T>
using TableOf = decltype(std::declval<const Policy&>().template prepare<V>(
    std::declval<const ChoicePoint<T>&>(), std::declval<const LightColumns<T>&>(),
    std::declval<Scratch&>()));

/// A point of the batch as policies see it.
template <class T>
ChoicePoint<T> choice_point(const TileJob<T>& job, const Batch<T>& batch, std::size_t p)
{
    return choice_point(job, job.points[batch.tile_point[p]]);
}

/// Leaves a policy's table for each point of the batch from `first` on.
template <class V, class Policy, class T>
void prepare_tables(const TileJob<T>& job, Batch<T>& batch, std::size_t first, Scratch& scratch)
{
    using Table = TableOf<Policy, V, T>;
    const auto place = [&](std::size_t p) { return reinterpret_cast<Table*>(&batch.tables[p]); };
    if constexpr (requires { Table::most_kept; }) {
        // Of many lights some at a time for all points, so that memory is read once.
        if (job.columns.count > Table::most_kept) {
            constexpr std::size_t step = 64;
            const std::size_t blocks = Table::blocks_of(job.columns.count);
            for (std::size_t p = first; p < batch.points; ++p)
                ::new (place(p))
                    Table(Table::begin(choice_point(job, batch, p), job.columns, scratch));
            for (std::size_t b = 0; b < blocks; b += step)
                for (std::size_t p = first; p < batch.points; ++p)
                    place(p)->fill_more(b, std::min(b + step, blocks));
            for (std::size_t p = first; p < batch.points; ++p) place(p)->end(job.columns);
            return;
        }
    }
    const Policy& policy = *static_cast<const Policy*>(job.policy);
    for (std::size_t p = first; p < batch.points; ++p)
        ::new (place(p))
            Table(policy.template prepare<V>(choice_point(job, batch, p), job.columns, scratch));
}

template <class T> void fill_kernels(Kernels<T>& kernels)
{
    using V = instruction_set::Lanes<T>;
    kernels.instruction_set = instruction_set::name;
    kernels.lanes = lane_count<V>;
    kernels.light_numbers = light_numbers<T>;
    kernels.bsdf_numbers = bsdf_numbers<T>;
    kernels.sobol_light_numbers = sobol_light_numbers<T>;
    kernels.sobol_bsdf_numbers = sobol_bsdf_numbers<T>;
    kernels.screen_meeting = screen_meeting<V, T>;
    kernels.screen_hiding = screen_hiding<V, T>;
    kernels.weigh_alone = weigh_alone<V, T>;
    kernels.sums = {SumStages<T>{add_contributions<1, T>, find_luminances<1, T>, sum_run<1, T>},
                    SumStages<T>{add_contributions<3, T>, find_luminances<3, T>, sum_run<3, T>}};
    kernels.strata = {find_shares<V, T>, part_lights<V, T>, learn_tile<V, T>,
                      learn_block<V, T>, strata_numbers<T>, price_light<ExpectedDraws<T>, T>};
    for_each_type(Policies{}, [&]<class P>() {
        using Table = TableOf<P, V, T>;
        kernels.policies.push_back({P::name, P::draws_every_light, P::reads_all_lights,
                                    [](std::size_t lights) { return P::table_bytes(lights); },
                                    prepare_tables<V, P, T>,
                                    choose_light<instruction_set::Lanes<double>, P, Table, T>,
                                    choose_only_light<P, Table, T>, price_light<Table, T>,
                                    sum_light_draw<Table, T>, sum_bsdf_draw<Table, T>});
    });
    for_each_type(Techniques{}, [&]<class K>() {
        if constexpr (K::chooses_light)
            kernels.light_techniques.push_back(
                {K::name, K::sums_lights, draw_light<V, K, T>, pdf_of_light<V, K, T>});
        else
            for_each_type(Bsdfs{}, [&]<class B>() {
                using Asked = std::conditional_t<K::asks_bsdf, FormulaOf<B>, NoBsdf>;
                kernels.directions.push_back(
                    {K::name, B::name, draw_direction<V, Asked, K, T>, pdf_of_direction<V, K, T>});
            });
    });
    for_each_type(Bsdfs{}, [&]<class B>() {
        using F = FormulaOf<B>;
        Stage<T> parts = nullptr;
        if constexpr (B::has_lobe) parts = weigh_parts<V, F, BalanceHeuristic, T>;
        kernels.bsdfs.push_back(
            {B::name,
             {{{evaluate_bsdf<V, F, false, false, T>, evaluate_bsdf<V, F, false, true, T>},
               {evaluate_bsdf<V, F, true, false, T>, evaluate_bsdf<V, F, true, true, T>}}},
             parts});
    });
    for_each_type(Heuristics{}, [&]<class H>() {
        kernels.heuristics.push_back({H::name, weigh_light<V, H, T>, weigh_bsdf<V, H, T>});
    });
}

}  // namespace MIS_ISA

#define MIS_JOIN_OF(a, b) a##b
#define MIS_JOIN(a, b) MIS_JOIN_OF(a, b)

/// What the engine calls: fill_float_avx2() and its kin (engine/kernel_choice.cpp).
void MIS_JOIN(fill_float_, MIS_ISA)(Kernels<float>& kernels) { MIS_ISA::fill_kernels(kernels); }
void MIS_JOIN(fill_double_, MIS_ISA)(Kernels<double>& kernels) { MIS_ISA::fill_kernels(kernels); }

}  // namespace mis
