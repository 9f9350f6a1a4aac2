#include "mis/bind/c.h"

#include "mis/engine/direct.h"
#include "mis/heuristic/registry.h"
#include "mis/policy/registry.h"
#include "mis/scene/validate.h"
#include "mis/strategy/strategy.h"
#include "mis/technique/registry.h"

#include <algorithm>
#include <memory>
#include <new>
#include <string>

using namespace mis;  // NOLINT: what this file binds

namespace {

/// One sample of a strategy, compiled for its heuristic and technique.
using Sampler = DirectSample<float>(const AnyDirectPoint<float>&, const Strategy&, const mis_bsdf&,
                                    const mis_rays&, const mis_random&);

}  // namespace

/// The lights under one strategy, whatever its policy.
struct mis_lights {
    Strategy strategy;
    Sampler* sampler;
    mis_lights(Strategy parsed, Sampler* found) : strategy(std::move(parsed)), sampler(found) {}
    virtual ~mis_lights() = default;
    virtual void assign(Lights lights) = 0;
    virtual std::size_t count() const = 0;
    virtual void replace(LightIndex index, const Light& light) = 0;
    virtual std::unique_ptr<mis_point> point() const = 0;
};

struct mis_point {
    const mis_lights* among;
    explicit mis_point(const mis_lights& lights) : among(&lights) {}
    virtual ~mis_point() = default;
    virtual void move_to(const Vec3<double>& x, const Vec3<float>& n) = 0;
    virtual AnyDirectPoint<float> view() const = 0;
};

namespace {

/// A host's BSDF by its functions.
struct CalledBsdf {
    const mis_bsdf* host;
    Vec3<float> evaluate(const Vec3<float>& wi) const
    {
        Vec3<float> f(0);
        host->evaluate(host->self, &wi.x, &f.x);
        return f;
    }
    float pdf(const Vec3<float>& wi) const { return host->pdf(host->self, &wi.x); }
    Vec3<float> sample(float lobe, const Vec2<float>& u) const
    {
        Vec3<float> wi(0);
        host->sample(host->self, lobe, &u.x, &wi.x);
        return wi;
    }
};

mis_numbers numbers_of(const mis_random& random, int draw)
{
    mis_numbers u{};
    random.numbers(random.self, draw, &u);
    return u;
}

DirectNumbers<float> direct_numbers(const mis_numbers& u)
{
    return {u.choice, {u.cap[0], u.cap[1]}, u.lobe, {u.bsdf[0], u.bsdf[1]}};
}

template <class Heuristic, class Technique>
DirectSample<float> sample_by(const AnyDirectPoint<float>& point, const Strategy& strategy,
                              const mis_bsdf& bsdf, const mis_rays& rays, const mis_random& random)
{
    const CalledBsdf called{&bsdf};
    const auto is_occluded = [&](const Vec3<float>& wi, float distance) {
        return rays.is_occluded(rays.self, &wi.x, distance) != 0;
    };
    if (strategy.model == Model::one_sample) {
        const mis_numbers u = numbers_of(random, 0);
        return sample_direct_once<Heuristic, Technique>(point, called, is_occluded, u.technique,
                                                        direct_numbers(u));
    }
    const auto numbers = [&](int draw) { return direct_numbers(numbers_of(random, draw)); };
    return sample_direct<Heuristic, Technique>(point, called, is_occluded, numbers,
                                               strategy.counts[0], strategy.counts[1]);
}

Sampler* sampler_of(const Strategy& strategy)
{
    Sampler* found = nullptr;
    visit_named(Heuristics{}, strategy.heuristic, [&]<class Heuristic>() {
        visit_named(Techniques{}, strategy.technique, [&]<class Technique>() {
            if constexpr (Technique::chooses_light) found = sample_by<Heuristic, Technique>;
        });
    });
    return found;
}

template <class Policy> class BoundPoint final : public mis_point {
public:
    BoundPoint(const mis_lights& bound, const DirectLights<Policy>& lights)
        : mis_point(bound), point_(lights)
    {
    }
    void move_to(const Vec3<double>& x, const Vec3<float>& n) override { point_.move_to(x, n); }
    AnyDirectPoint<float> view() const override { return AnyDirectPoint<float>(point_); }

private:
    DirectPoint<Policy> point_;
};

template <class Policy> class BoundLights final : public mis_lights {
public:
    BoundLights(const Strategy& parsed, Sampler* found, Lights lights)
        : mis_lights(parsed, found), lights_(std::move(lights))
    {
    }
    void assign(Lights lights) override { lights_.assign(std::move(lights)); }
    std::size_t count() const override { return lights_.lights().size(); }
    void replace(LightIndex index, const Light& light) override { lights_.replace(index, light); }
    std::unique_ptr<mis_point> point() const override
    {
        return std::make_unique<BoundPoint<Policy>>(*this, lights_);
    }

private:
    DirectLights<Policy> lights_;
};

/// nullptr for a strategy that chooses no light.
std::unique_ptr<mis_lights> bound(const Strategy& strategy, Lights lights)
{
    std::unique_ptr<mis_lights> made;
    Sampler* sampler = sampler_of(strategy);
    if (sampler == nullptr) return made;
    visit_named(Policies{}, strategy.policy, [&]<class Policy>() {
        made = std::make_unique<BoundLights<Policy>>(strategy, sampler, std::move(lights));
    });
    return made;
}

void say(const std::string& text, char* message, std::size_t capacity)
{
    if (message == nullptr || capacity == 0) return;
    const std::size_t length = std::min(text.size(), capacity - 1);
    std::copy_n(text.data(), length, message);
    message[length] = 0;
}

/// What is wrong with a host's light, or "".
std::string problem_of(const mis_light& light)
{
    const auto problem = find_light_problem(
        {light.center[0], light.center[1], light.center[2]}, light.radius, Emission::radiance,
        {light.radiance[0], light.radiance[1], light.radiance[2]});
    return problem ? problem->pointer + ": found " + problem->found + "; " + problem->allowed : "";
}

mis_status read_lights(const mis_light* list, std::size_t count, Lights& lights, char* message,
                       std::size_t capacity)
{
    if (list == nullptr && count > 0) return MIS_BAD_ARGUMENT;
    if (count > limits::lights) {
        say(std::to_string(count) + " lights; at most " + std::to_string(limits::lights), message,
            capacity);
        return MIS_BAD_LIGHT;
    }
    lights.reserve(count);
    for (std::size_t j = 0; j < count; ++j) {
        const mis_light& l = list[j];
        if (const std::string problem = problem_of(l); !problem.empty()) {
            say("light " + std::to_string(j) + problem, message, capacity);
            return MIS_BAD_LIGHT;
        }
        lights.push_back(make_light({l.center[0], l.center[1], l.center[2]}, l.radius,
                                    {l.radiance[0], l.radiance[1], l.radiance[2]}));
    }
    return MIS_OK;
}

}  // namespace

extern "C" {

mis_status mis_lights_create(const char* strategy, const mis_light* lights, size_t count,
                             mis_lights** out, char* message, size_t capacity)
{
    if (strategy == nullptr || out == nullptr) return MIS_BAD_ARGUMENT;
    *out = nullptr;
    say("", message, capacity);
    try {
        Lights read;
        if (const mis_status status = read_lights(lights, count, read, message, capacity);
            status != MIS_OK)
            return status;
        const Strategy parsed = parse_sample_strategy(strategy);
        std::unique_ptr<mis_lights> made = bound(parsed, std::move(read));
        if (!made) {
            say(std::string("\"") + strategy + "\" chooses no light: it is the host's own draw",
                message, capacity);
            return MIS_BAD_STRATEGY;
        }
        *out = made.release();
        return MIS_OK;
    } catch (const StrategyError& error) {
        say(error.what(), message, capacity);
        return MIS_BAD_STRATEGY;
    } catch (const std::bad_alloc&) {
        return MIS_NO_MEMORY;
    }
}

mis_status mis_lights_assign(mis_lights* lights, const mis_light* list, size_t count, char* message,
                             size_t capacity)
{
    if (lights == nullptr) return MIS_BAD_ARGUMENT;
    say("", message, capacity);
    try {
        Lights read;
        const mis_status status = read_lights(list, count, read, message, capacity);
        if (status == MIS_OK) lights->assign(std::move(read));
        return status;
    } catch (const std::bad_alloc&) {
        return MIS_NO_MEMORY;
    }
}

mis_status mis_lights_replace(mis_lights* lights, size_t index, const mis_light* light,
                              char* message, size_t capacity)
{
    if (lights == nullptr || light == nullptr || index >= lights->count()) return MIS_BAD_ARGUMENT;
    say("", message, capacity);
    try {
        Lights read;
        const mis_status status = read_lights(light, 1, read, message, capacity);
        if (status == MIS_OK) lights->replace(static_cast<LightIndex>(index), read.front());
        return status;
    } catch (const std::bad_alloc&) {
        return MIS_NO_MEMORY;
    }
}

void mis_lights_destroy(mis_lights* lights) { delete lights; }

mis_status mis_point_create(const mis_lights* lights, mis_point** out)
{
    if (lights == nullptr || out == nullptr) return MIS_BAD_ARGUMENT;
    *out = nullptr;
    try {
        *out = lights->point().release();
        return MIS_OK;
    } catch (const std::bad_alloc&) {
        return MIS_NO_MEMORY;
    }
}

void mis_point_destroy(mis_point* point) { delete point; }

int mis_point_move_to(mis_point* point, const double x[3], const float n[3])
{
    point->move_to({x[0], x[1], x[2]}, {n[0], n[1], n[2]});
    return point->view().is_lit() ? 1 : 0;
}

int32_t mis_point_choose(const mis_point* point, uint64_t bits, double* probability)
{
    const Choice choice = point->view().choose(bits);
    if (probability != nullptr) *probability = choice.probability;
    return choice.light;
}

double mis_point_probability(const mis_point* point, int32_t light)
{
    return point->view().probability(light);
}

int mis_point_sample(const mis_point* point, const mis_bsdf* bsdf, const mis_rays* rays,
                     const mis_random* random, float radiance[3])
{
    const DirectSample<float> sample =
        point->among->sampler(point->view(), point->among->strategy, *bsdf, *rays, *random);
    radiance[0] = sample.radiance.x, radiance[1] = sample.radiance.y,
    radiance[2] = sample.radiance.z;
    return sample.invalid;
}

}  // extern "C"
