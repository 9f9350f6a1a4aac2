#pragma once

#include "mis/math/sphere.h"
#include "mis/math/stop_token.h"
#include "mis/scene/light.h"
#include "mis/trace/beam.h"
#include "mis/trace/light_boxes.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mis {

/// The light that a direction meets, and how far; light is no_light and distance infinity where it
/// meets none.
struct LightHit {
    LightIndex light = no_light;
    double distance = std::numeric_limits<double>::infinity();
};

/// Is it met before another one? At equal distance, the one listed first is.
inline bool stands_before(const LightHit& a, const LightHit& b)
{
    return a.distance < b.distance || (a.distance == b.distance && a.light < b.light);
}

/// Which light does a direction meet first, and whose caps hold it? A bounding volume hierarchy
/// over the spheres, which never enter the surfaces' tree. Boxes are float and wide enough for
/// every rounding; what they let through is tested in double, so the answers are those of a loop
/// over all lights. Directions are unit vectors.
class LightHierarchy {
public:
    /// Keeps a reference to the lights. Throws Stopped.
    explicit LightHierarchy(const Lights& lights, const StopToken& stop = {});

    /// Light j has become another sphere, and stood where `before` says: the boxes around it are
    /// made anew, O(log M) of them, and nothing allocates. Answers are those of a new hierarchy;
    /// where many lights have gone far, it takes longer to find them than a new one would.
    void refit(LightIndex j, const Light& before);

    /// Is x inside a light or on it?
    bool contains(const Vec3<double>& x) const;

    /// The nearest light along wi from x, which lies outside all lights; at equal distance the one
    /// listed first.
    LightHit nearest(const Vec3<double>& x, const Vec3<double>& wi) const
    {
        return walked(Nearest{x, wi}).best;
    }

    /// Does another light stand before the one that is met? Coincident, the one listed first does.
    bool hides(const Vec3<double>& x, const Vec3<double>& wi, const LightHit& hit) const
    {
        return walked(Hides{x, wi, hit.light, hit.distance, hit}).is_hidden;
    }

    /// The same two, where only `others` can be met, or stand before it.
    LightHit nearest(const Vec3<double>& x, const Vec3<double>& wi,
                     std::span<const ListedLight> others) const;
    bool hides(const Vec3<double>& x, const Vec3<double>& wi, const LightHit& hit,
               std::span<const ListedLight> others) const;

    /// What is asked of many rays: several are under way at a time, so that one computes while
    /// another waits for memory. The answers are those of one after the other.
    struct Ray {
        Vec3<double> x, wi;
    };
    /// done(i, LightHit) for each ray_of(i), i < count, in no order.
    template <class RayOf, class Done>
    void nearest_each(std::size_t count, const RayOf& ray_of, const Done& done) const
    {
        walk_each(
            count,
            [&](std::size_t i) {
                const Ray ray = ray_of(i);
                return Nearest{ray.x, ray.wi};
            },
            [&](std::size_t i, const Nearest& task) { done(i, task.best); });
    }
    /// done(i, is_hidden) for each ray_of(i) to hit_of(i, ray), i < count, in no order.
    template <class RayOf, class HitOf, class Done>
    void hides_each(std::size_t count, const RayOf& ray_of, const HitOf& hit_of,
                    const Done& done) const
    {
        walk_each(
            count,
            [&](std::size_t i) {
                const Ray ray = ray_of(i);
                const LightHit hit = hit_of(i, ray);
                return Hides{ray.x, ray.wi, hit.light, hit.distance, hit};
            },
            [&](std::size_t i, const Hides& task) { done(i, task.is_hidden); });
    }

    /// visit(LightHit) for every light along wi, hidden ones too, in no order.
    template <class Visit>
    void for_each_along(const Vec3<double>& x, const Vec3<double>& wi, const Visit& visit) const
    {
        walked(Along<Visit>{x, wi, &visit});
    }

    /// All lights, such that neighbours stand together.
    std::span<const LightIndex> order() const { return {order_.data(), order_.size()}; }

    /// Amid the lights; scene units.
    const Vec3<double>& origin() const { return origin_; }

    std::size_t bytes() const
    {
        return nodes_.size() * sizeof(Node) + order_.size() * sizeof(LightIndex);
    }

    using Node = LightNode;

private:
    struct Builder;
    struct Refit;

    /// Along wi from x; infinity: it is not met.
    double distance_to(LightIndex j, const Vec3<double>& x, const Vec3<double>& wi) const
    {
        const Light& light = (*lights_)[static_cast<std::size_t>(j)];
        const Vec3<double> to_center = light.center - x;
        return meets_sphere(to_center, light.radius, wi) ? hit_distance(to_center, light.radius, wi)
                                                         : std::numeric_limits<double>::infinity();
    }

    // What is looked for along a ray. limit: beyond it, nothing is of interest; but: not asked.
    static constexpr double everything = std::numeric_limits<double>::infinity();
    struct Nearest {
        Vec3<double> x, wi;
        LightIndex but = no_light;
        double limit = everything;
        LightHit best = {};
        void meet(const LightHit& hit)
        {
            if (stands_before(hit, best)) best = hit, limit = hit.distance;
        }
    };
    struct Hides {
        Vec3<double> x, wi;
        LightIndex but;
        double limit;
        LightHit hit;
        bool is_hidden = false;
        void meet(const LightHit& other)
        {
            if (stands_before(other, hit)) is_hidden = true, limit = -1;
        }
    };
    template <class Visit> struct Along {
        Vec3<double> x, wi;
        const Visit* visit;
        LightIndex but = no_light;
        double limit = everything;
        void meet(const LightHit& hit) { (*visit)(hit); }
    };
    template <class Task> class Walk;
    template <class Task> Task walked(const Task& task) const;
    /// Walks under way at a time. Where the hierarchy is larger than a near cache, so many that the
    /// node that one has asked for is there when its turn comes again.
    static constexpr std::size_t few_walks = 4, many_walks = 16, near_cache = std::size_t{1} << 20;
    template <class TaskOf, class Done>
    void walk_each(std::size_t count, const TaskOf& task_of, const Done& done) const
    {
        if (bytes() <= near_cache) walk_together<few_walks>(count, task_of, done);
        else walk_together<many_walks>(count, task_of, done);
    }
    template <std::size_t at_once, class TaskOf, class Done>
    void walk_together(std::size_t count, const TaskOf& task_of, const Done& done) const;

    const Lights* lights_;
    Vec3<double> origin_{0};
    LargeVector<Node> nodes_;
    LargeVector<LightIndex> order_;
};

/// The lights along a ray, one node of the hierarchy at a time.
template <class Task> class LightHierarchy::Walk {
public:
    void start(const LightHierarchy& hierarchy, const Task& what)
    {
        task = what;
        ray_ = BoxRay(task.x - hierarchy.origin_, task.wi);
        stack_.node[0] = 0, stack_.near[0] = 0, stack_.count = hierarchy.nodes_.empty() ? 0 : 1;
    }

    /// Opens the next node; false where none is left.
    bool step(const LightHierarchy& hierarchy)
    {
        const float limit = static_cast<float>(task.limit) * 1.000001F;
        std::size_t next = stack_.count;
        do {
            if (next == 0) return false;
        } while (stack_.near[--next] > limit);
        stack_.count = next;
        const Node& node = hierarchy.nodes_[stack_.node[next]];
        for (std::uint32_t met = ray_.open(node, limit, stack_); met != 0; met &= met - 1)
            meet(hierarchy,
                 hierarchy
                     .order_[node.first_light + static_cast<std::uint32_t>(std::countr_zero(met))]);
        return true;
    }

    /// Asks memory for the node that is next.
    void ask_ahead(const LightHierarchy& hierarchy) const
    {
        if (stack_.count == 0) return;
        const auto* node =
            reinterpret_cast<const std::byte*>(&hierarchy.nodes_[stack_.node[stack_.count - 1]]);
        __builtin_prefetch(node);
        __builtin_prefetch(node + 64);  // it is on two lines
    }

    Task task;
    std::size_t number = 0;  ///< of the caller

private:
    void meet(const LightHierarchy& hierarchy, LightIndex j)
    {
        if (j == task.but) return;
        const double distance = hierarchy.distance_to(j, task.x, task.wi);
        if (distance <= task.limit && distance < std::numeric_limits<double>::infinity())
            task.meet({j, distance});
    }

    BoxRay ray_;
    WaitingNodes stack_;  // NOLINT: filled before it is read
};

template <class Task> Task LightHierarchy::walked(const Task& task) const
{
    Walk<Task> walk;  // NOLINT
    walk.start(*this, task);
    while (walk.step(*this)) {
    }
    return walk.task;
}

template <std::size_t at_once, class TaskOf, class Done>
void LightHierarchy::walk_together(std::size_t count, const TaskOf& task_of, const Done& done) const
{
    using Task = decltype(task_of(std::size_t{}));
    std::array<Walk<Task>, at_once> walks;  // NOLINT
    std::array<Walk<Task>*, at_once> under_way{};
    std::size_t started = 0, running = 0;
    const auto start = [&](Walk<Task>& walk) {
        walk.number = started;
        walk.start(*this, task_of(started++));
    };
    for (Walk<Task>& walk : walks)
        if (started < count) start(walk), under_way[running++] = &walk;
    while (running > 0)
        for (std::size_t w = 0; w < running; ++w) {
            if (under_way[w]->step(*this)) {
                if constexpr (at_once > few_walks) under_way[w]->ask_ahead(*this);
                continue;
            }
            done(under_way[w]->number, under_way[w]->task);
            if (started < count) start(*under_way[w]);
            else under_way[w--] = under_way[--running];
        }
}

}  // namespace mis
