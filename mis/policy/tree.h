#pragma once

#include "mis/policy/tree_paths.h"
#include "mis/policy/tree_weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mis {

/// Draws lights by a hierarchy over them, nearly as `product` would if it could look at them all.
/// At each point some dozen groups are opened, those whose guessed worth is most in doubt; a draw
/// goes through them, and then down to one light, which is weighed as `product` does among its
/// neighbours. docs/theory.md, eqs. 65 to 69.
class TreePolicy {
public:
    static constexpr std::string_view name = "tree";
    static constexpr std::string_view summary =
        "nearly as product, by a hierarchy over the lights: O(log M)";
    /// Of few lights it opens all groups, and is `product`.
    static constexpr bool ranked_by_default(std::size_t lights, bool) { return lights > 32; }
    static constexpr bool draws_every_light = false, reads_all_lights = false,
                          draws_go_together = true;
    /// Groups opened at a point: of up to some 330 lights all, where `tree` is `product`.
    static constexpr std::size_t most_open = 24;
    /// Of them so many at once, so that none waits for what is found in another.
    static constexpr std::size_t open_at_once = 3;
    /// No part is opened whose doubt is less than this share of all weights.
    static constexpr double least_doubt = 0.0003;
    static constexpr std::size_t table_bytes(std::size_t)
    {
        return Scratch::bytes_for<TreePoint<double>>(1) +
               Scratch::bytes_for<OpenGroup<double>>(most_open);
    }

    explicit TreePolicy(const Lights& lights, const StopToken& stop = {})
        : tree_(std::make_shared<const LightTree>(lights, stop))
    {
    }

    const LightTree& tree() const { return *tree_; }

    template <class T> class Table {
    public:
        MIS_INLINE Choice choose(std::uint64_t bits) const { return follow(DrawnPath(bits)); }
        MIS_INLINE double probability(LightIndex light) const
        {
            return follow(KnownPath(tree_->slot_of(light))).probability;
        }

        /// What table_of(i).choose(bits[i]) gives, to put(i, choice), in no order. The draws go
        /// down together, a group each at a time, so that no draw waits alone for what it reads.
        template <std::size_t most, class TableOf, class Put>
        MIS_INLINE static void choose_each(std::span<const std::uint64_t> bits,
                                           const TableOf& table_of, const Put& put)
        {
            std::array<Descent, most> below;  // NOLINT: filled as far as it is read
            std::size_t count = 0;
            for (std::size_t i = 0; i < bits.size(); ++i) {
                Descent& draw = below[count];
                draw = {&table_of(i), i, DrawnPath(bits[i])};
                if (draw.table->follow_open(draw.path, draw.at, draw.choice)) {
                    draw.table->fetch_ahead(draw.at);
                    ++count;
                } else {
                    put(i, draw.choice);
                }
            }
            while (count > 0) {
                std::size_t kept = 0;
                for (std::size_t i = 0; i < count;) {
                    const Table& table = *below[i].table;  // its draws stand together
                    visit_reflection<T>(
                        table.at_->point, [&](const auto& reflection) __attribute__((
                                              always_inline)) {
                            for (; i < count && below[i].table == &table; ++i) {
                                Descent& draw = below[i];
                                if (table.step(reflection, draw.path, draw.at, draw.choice)) {
                                    table.fetch_ahead(draw.at);
                                    below[kept++] = draw;
                                } else {
                                    put(draw.number, draw.choice);
                                }
                            }
                        });
                }
                count = kept;
            }
        }

    private:
        friend TreePolicy;
        using Lights = LightTree::LightGroup;
        using Parts = LightTree::NodeGroup;

        /// Part k of a group.
        struct Part {
            const Parts* of = nullptr;
            std::size_t k = 0;
            bool is_even = false;  ///< are the lights in it drawn by power?
            std::uint32_t child() const { return of->child + static_cast<std::uint32_t>(k); }
        };
        /// A draw on its way down.
        struct Descent {
            const Table* table = nullptr;
            std::size_t number = 0;
            DrawnPath path{0};
            Part at;
            Choice choice{no_light, 0};
        };

        template <class Path> MIS_INLINE Choice follow(Path path) const
        {
            Choice choice{no_light, 0};
            Part at;
            if (!follow_open(path, at, choice)) return choice;
            visit_reflection<T>(
                at_->point, [&](const auto& reflection) __attribute__((always_inline)) {
                    while (step(reflection, path, at, choice)) {
                    }
                });
            return choice;
        }

        /// Through the open groups, whose weights are known. Is there more below?
        template <class Path>
        MIS_INLINE bool follow_open(Path& path, Part& at, Choice& choice) const
        {
            if (open_ == nullptr || !(open_[0].sums.back() > 0)) return false;
            choice.probability = 1;
            for (const OpenGroup<Scalar<T>>* open = open_;;) {
                if (open->is_of_lights) {
                    take_light(path, tree_->lights()[open->group], open->sums, choice);
                    return false;
                }
                at.of = &tree_->nodes()[open->group];
                at.k = path.part(open->sums, *at.of);
                choice.probability *= share_of(open->sums, at.k);
                if (open->opened[at.k] == 0) {
                    at.is_even = !(open->doubts[at.k] > 0);
                    return choice.probability > 0;
                }
                open = &open_[open->opened[at.k]];
            }
        }

        /// Into a part, weighing what is met there. Is there more below?
        template <class Reflection, class Path>
        MIS_INLINE bool step(const Reflection& reflection, Path& path, Part& at,
                             Choice& choice) const
        {
            LightRow sums;  // NOLINT: filled before it is read
            if (at.of->is_lowest != 0) {
                const Lights& lights = tree_->lights()[at.child()];
                if (!at.is_even) weigh_lights<T>(reflection, *at_, lights, sums);
                // All of them below the horizon, which was not seen from above: any will do.
                if (at.is_even || !sum_up(sums)) take_powers(lights, sums), sum_up(sums);
                take_light(path, lights, sums, choice);
                return false;
            }
            LightTree::Row<Scalar<T>> doubts;  // NOLINT
            at.of = &tree_->nodes()[at.child()];
            if (!at.is_even) weigh_parts<T>(reflection, *at_, *at.of, sums, doubts);
            if (at.is_even || !sum_up(sums)) {
                take_powers(*at.of, sums), sum_up(sums);
                at.k = path.part(sums, *at.of);
            } else {
                at.k = path.part(sums, *at.of);
                at.is_even = !(doubts[at.k] > 0);
            }
            choice.probability *= share_of(sums, at.k);
            return choice.probability > 0;
        }

        /// Asks for what step() will read.
        MIS_INLINE void fetch_ahead(const Part& at) const
        {
            if (at.of->is_lowest != 0) {
                const Lights& lights = tree_->lights()[at.child()];
                if (at.is_even) fetch(&lights.radius, sizeof lights - offsetof(Lights, radius));
                else fetch(&lights, sizeof lights);
            } else {
                const Parts& parts = tree_->nodes()[at.child()];
                if (at.is_even) fetch(&parts.power, 1), fetch(&parts.origin, 1);
                else fetch(&parts, offsetof(Parts, first));
            }
        }
        MIS_INLINE static void fetch(const void* data, std::size_t size)
        {
            const auto* bytes = static_cast<const std::byte*>(data);
            for (std::size_t line = 0; line < size; line += 64)
                __builtin_prefetch(bytes + line, 0, 2);
        }

        template <class Path>
        MIS_INLINE static void take_light(Path& path, const Lights& lights, const LightRow& sums,
                                          Choice& choice)
        {
            const std::size_t k = path.light(sums);
            choice.probability *= share_of(sums, k);
            choice.light = lights.light[k];
        }

        const LightTree* tree_ = nullptr;
        const TreePoint<Scalar<T>>* at_ = nullptr;
        const OpenGroup<Scalar<T>>* open_ =
            nullptr;  ///< the first is the root; nullptr without a light
    };

    template <class T>
    Table<T> prepare(const ChoicePoint<Scalar<T>>& point, const LightColumns<Scalar<T>>&,
                     Scratch& scratch) const
    {
        Table<T> table;
        table.tree_ = tree_.get();
        if (tree_->lights().empty()) return table;
        TreePoint<Scalar<T>>& at = scratch.take<TreePoint<Scalar<T>>>(1)[0];
        using Open = OpenGroup<Scalar<T>>;
        const std::span<Open> open = scratch.take<Open>(most_open);
        at = seen_from(point);
        visit_reflection<T>(
            point, [&](const auto& reflection)
                       __attribute__((always_inline)) { open_groups<T>(reflection, at, open); });
        table.at_ = &at, table.open_ = open.data();
        return table;
    }

private:
    template <class S> MIS_INLINE TreePoint<S> seen_from(const ChoicePoint<S>& point) const
    {
        const Vec3<double> x = point.origin + vec_cast<double>(point.x);
        const Vec3<double> from_middle = x - tree_->middle();
        // A power of two: it changes no digit, wherever the scene stands.
        TreePoint<S> at{point, x, std::exp2(-std::ilogb(length(from_middle) + tree_->reach()))};
        at.point.x *= static_cast<S>(at.inverse_unit);
        return at;
    }

    /// Weighs what is in a group that `order` has found.
    template <class T, class Reflection>
    MIS_INLINE void look_into(const Reflection& reflection, const TreePoint<Scalar<T>>& at,
                              OpenGroup<Scalar<T>>& group, bool may_open_all) const
    {
        group.opened = {};
        if (group.is_of_lights)
            weigh_lights<T>(reflection, at, tree_->lights()[group.group], group.sums);
        else
            weigh_parts<T>(reflection, at, tree_->nodes()[group.group], group.sums, group.doubts,
                           !may_open_all);
    }

    /// Opens groups from the root on, always the parts that are most in doubt; then gives parts
    /// that were opened the weight that was found within.
    template <class T, class Reflection>
    MIS_INLINE void open_groups(const Reflection& reflection, const TreePoint<Scalar<T>>& at,
                                std::span<OpenGroup<Scalar<T>>> open) const
    {
        const bool may_open_all = tree_->nodes().size() + tree_->lights().size() <= most_open;
        OpenOrder<Scalar<T>, most_open> order;
        open[0].group = 0, open[0].is_of_lights = false;
        std::size_t known = 0, count = 1;
        while (known < count) {
            for (; known < count; ++known) look_into<T>(reflection, at, open[known], may_open_all);
            for (std::size_t i = order.count(); i < count; ++i) order.add(open[i]);
            const std::size_t most = std::min(count + open_at_once, most_open);
            while (count < most &&
                   order.next(open, *tree_, may_open_all ? 0 : least_doubt, open[count]))
                ++count;
        }
        while (--count > 0) {
            sum_up(open[count].sums);
            open[order.from(count).group].sums[order.from(count).part] = open[count].sums.back();
        }
        sum_up(open[0].sums);
    }

    std::shared_ptr<const LightTree> tree_;
};
static_assert(LightChoice<TreePolicy, float>);

}  // namespace mis
