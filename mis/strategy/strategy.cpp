#include "mis/strategy/strategy.h"

#include "mis/heuristic/registry.h"
#include "mis/math/raise.h"
#include "mis/policy/registry.h"
#include "mis/scene/named.h"
#include "mis/scene/nearest_name.h"
#include "mis/strategy/names.h"
#include "mis/technique/registry.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace mis {

namespace {

template <class List> std::vector<Choosable> listed(List list)
{
    std::vector<Choosable> names;
    for_each_type(list, [&]<class C>() {
        names.push_back({std::string(C::name), std::string(C::summary)});
        if constexpr (requires { C::ranked_by_default; })
            names.back().ranked_by_default = C::ranked_by_default;
        if constexpr (requires { C::ranked_by_default_with; })
            names.back().ranked_by_default_with = C::ranked_by_default_with;
    });
    return names;
}

std::string known(const std::vector<Choosable>& list) { return comma_list(names_in(list)); }

/// "\n    Did you mean …?", or nothing where no name is near.
std::string suggestion(std::string_view found, const std::vector<Choosable>& list)
{
    const std::string_view near = nearest_name(found, names_in(list));
    return near.empty() ? "" : "\n    Did you mean \"" + std::string(near) + "\"?";
}

[[noreturn]] void refuse_unknown(std::string_view strategy, std::string_view kind,
                                 std::string_view found, const std::vector<Choosable>& list)
{
    raise<StrategyError>("strategy \"" + std::string(strategy) + "\": " +
                         unknown_name("found " + std::string(kind), found, names_in(list)));
}

[[noreturn]] void refuse(std::string_view strategy, const std::string& reason)
{
    raise<StrategyError>("strategy \"" + std::string(strategy) + "\": " + reason);
}

/// A count of draws: digits alone, at most a million.
std::optional<int> whole_number(std::string_view digits)
{
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool is_number = error == std::errc{} && end == digits.data() + digits.size();
    return is_number && number >= 0 && number <= 1'000'000 ? std::optional(number) : std::nullopt;
}

std::array<int, 2> parse_counts(std::string_view strategy, std::string_view text)
{
    const std::size_t plus = text.find('+');
    if (plus != std::string_view::npos) {
        const std::optional<int> light = whole_number(text.substr(0, plus)),
                                 bsdf = whole_number(text.substr(plus + 1));
        if (light && bsdf) return {*light, *bsdf};
    }
    refuse(strategy,
           "found counts \"@" + std::string(text) +
               "\"; counts are @LIGHT+BSDF draws per sample, 0 to 1000000 each, as in @4+1");
}

std::vector<std::string_view> split(std::string_view text, char separator)
{
    std::vector<std::string_view> parts;
    for (std::size_t at; (at = text.find(separator)) != std::string_view::npos;
         text.remove_prefix(at + 1))
        parts.push_back(text.substr(0, at));
    parts.push_back(text);
    return parts;
}

}  // namespace

std::vector<std::string> ranked_by_default(const std::vector<Choosable>& list, std::size_t lights,
                                           bool has_lobes)
{
    std::vector<std::string> names;
    for (const Choosable& c : list)
        if (c.ranked_by_default != nullptr && c.ranked_by_default(lights, has_lobes))
            names.push_back(c.name);
    return names;
}

std::vector<std::string> strategies_ranked_by_default(std::size_t lights, bool has_lobes)
{
    std::vector<std::string> names;
    for (const Choosable& c : technique_names())
        if (!c.ranked_by_default_with.empty())
            names.push_back(c.ranked_by_default_with + "/" + c.name);
    for (const std::string& name : ranked_by_default(technique_names(), lights, has_lobes))
        names.push_back(name);
    return names;
}

bool chooses_light(std::string_view technique)
{
    bool chooses = false;
    visit_named(Techniques{}, technique, [&]<class K>() { chooses = K::chooses_light; });
    return chooses;
}

bool draws_every_light(std::string_view policy)
{
    bool every = false;
    visit_named(Policies{}, policy, [&]<class P>() { every = P::draws_every_light; });
    return every;
}

bool reads_all_lights(std::string_view policy)
{
    bool looks = false;
    visit_named(Policies{}, policy, [&]<class P>() { looks = P::reads_all_lights; });
    return looks;
}

bool weighs_by_irradiance(std::string_view policy)
{
    bool weighs = false;
    visit_named(Policies{}, policy, [&]<class P>() {
        weighs = requires { P::weighs_by_irradiance; };
    });
    return weighs;
}

bool draws_by_irradiance(std::string_view technique)
{
    bool draws = false;
    visit_named(Techniques{}, technique, [&]<class K>() {
        draws = requires { K::draws_by_irradiance; };
    });
    return draws;
}

const std::vector<Choosable>& policy_names()
{
    static const std::vector<Choosable> names = listed(Policies{});
    return names;
}
const std::vector<Choosable>& heuristic_names()
{
    static const std::vector<Choosable> names = listed(Heuristics{});
    return names;
}
const std::vector<Choosable>& technique_names()
{
    static const std::vector<Choosable> names = listed(Techniques{});
    return names;
}

Strategy strata(int draws)
{
    return {.policy = "product",
            .heuristic = "balance",
            .technique = "projected",
            .model = Model::strata,
            .counts = {draws, lobe_draws(draws)}};
}

std::string too_many_lights(const Strategy& s, std::size_t lights)
{
    return name_of(s) + ": it keeps figures of each light at each point of a tile, and there are " +
           std::to_string(lights) + " lights; at most " + std::to_string(most_strata_lights) +
           " may be";
}

int samples_together(const Strategy& s)
{
    return s.model == Model::strata ? std::max(s.counts[0], 1) : 1;
}

std::string name_of(const Strategy& s)
{
    if (s.model == Model::strata)
        return std::string(strata_name) +
               (s.counts[0] > 0 ? "@" + std::to_string(s.counts[0]) : "");
    if (!s.chooses_light()) return s.technique;
    std::string name = s.policy + "/" + s.heuristic;
    if (s.technique != "cone") name += "/" + s.technique;
    if (s.model == Model::one_sample) name += "/one-sample";
    const std::array<int, 2> usual = s.heuristic == "light" ? std::array{1, 0} : std::array{1, 1};
    if (s.counts != usual)
        name += "@" + std::to_string(s.counts[0]) + "+" + std::to_string(s.counts[1]);
    return name;
}

Strategy checked(Strategy s)
{
    const std::string name = name_of(s);
    if (s.model == Model::strata) return s;
    if (find_named(technique_names(), s.technique) == nullptr)
        refuse_unknown(name, "technique", s.technique, technique_names());
    if (!s.chooses_light()) {
        if (chooses_light(s.technique))
            refuse(name, "\"" + s.technique + "\" draws towards a light: name a policy");
        if (!s.heuristic.empty() || s.model == Model::one_sample || s.counts != std::array{0, 1})
            refuse(name,
                   "a strategy that chooses no light has one draw and nothing to combine it with");
        return s;
    }
    if (find_named(policy_names(), s.policy) == nullptr)
        refuse_unknown(name, "policy", s.policy, policy_names());
    if (s.heuristic == "brdf" || s.heuristic == "cosine" || s.heuristic == "hemisphere")
        refuse(name, "it draws no light, so it has no policy; say \"" + s.heuristic + "\"");
    if (find_named(heuristic_names(), s.heuristic) == nullptr)
        refuse_unknown(name, "heuristic", s.heuristic, heuristic_names());
    if (!chooses_light(s.technique))
        refuse(name, "\"" + s.technique + "\" draws no light, so it has no policy; say \"" +
                         s.technique + "\"");
    const bool single = s.heuristic == "light";
    if (s.model == Model::one_sample) {
        if (single)
            refuse(name, "one-sample chooses between techniques, and \"light\" has only one");
        if (draws_every_light(s.policy))
            refuse(name, "one-sample draws one technique once, and \"" + s.policy +
                             "\" draws for every light");
        if (s.counts != std::array{1, 1})
            refuse(name, "one-sample takes one draw, so it has no counts");
    }
    if (s.counts[0] == 0) refuse(name, "it draws no light; say \"brdf\"");
    if (single && s.counts[1] != 0)
        refuse(name, "\"light\" has no BSDF draw; say @" + std::to_string(s.counts[0]) + "+0");
    if (!single && s.counts[1] == 0)
        refuse(name, "\"" + s.heuristic +
                         "\" combines light and BSDF draws, and there is none of the BSDF; say \"" +
                         s.policy + "/light@" + std::to_string(s.counts[0]) + "+0\"");
    return s;
}

namespace {

/// "strata" with what stands behind the "@".
Strategy parse_strata(std::string_view name, std::optional<std::string_view> draws)
{
    if (!draws) return strata(0);
    const std::optional<int> number = whole_number(*draws);
    if (!number || *number == 0 || *number > most_strata_draws)
        refuse(name, "found \"@" + std::string(*draws) +
                         "\"; its count is @N light draws per point, 1 to " +
                         std::to_string(most_strata_draws) + ", as in strata@64");
    return strata(*number);
}

}  // namespace

Strategy parse_strategy(std::string_view name)
{
    const std::size_t at = name.find('@');
    const std::vector<std::string_view> parts = split(name.substr(0, at), '/');
    if (parts[0] == strata_name) {
        if (parts.size() > 1)
            refuse(name, "\"strata\" stands alone: it has its own policy, technique and weights");
        return parse_strata(
            name, at == std::string_view::npos ? std::nullopt : std::optional(name.substr(at + 1)));
    }
    Strategy s;
    if (parts.size() == 1) {
        s.technique = parts[0];
        s.counts = {0, 1};
        if (find_named(policy_names(), parts[0]) != nullptr)
            refuse(name, "a policy needs a heuristic: \"" + std::string(parts[0]) +
                             "/light\", or one of " + known(heuristic_names()));
        if (find_named(technique_names(), parts[0]) == nullptr) {
            std::vector<Choosable> whole;
            for (const Choosable& c : technique_names())
                if (!mis::chooses_light(c.name)) whole.push_back(c);
            whole.push_back({std::string(strata_name), ""});
            raise<StrategyError>("found \"" + std::string(name) +
                                 "\"; a strategy is policy/heuristic, or one of " + known(whole) +
                                 suggestion(name, whole));
        }
    } else {
        s.policy = parts[0];
        s.heuristic = parts[1];
        if (s.policy.empty()) refuse_unknown(name, "policy", "", policy_names());
        if (s.heuristic == "light") s.counts = {1, 0};
        bool has_technique = false;
        for (std::size_t i = 2; i < parts.size(); ++i) {
            const bool is_technique = find_named(technique_names(), parts[i]) != nullptr;
            if (!is_technique && parts[i] != "one-sample") {
                std::vector<Choosable> allowed = technique_names();
                allowed.push_back({"one-sample", ""});
                refuse_unknown(name, "part", parts[i], allowed);
            }
            if (is_technique && has_technique) refuse(name, "a strategy has one technique");
            if (s.model == Model::one_sample)
                refuse(name, is_technique ? "the technique stands before \"one-sample\""
                                          : "\"one-sample\" stands there twice");
            if (is_technique) s.technique = parts[i], has_technique = true;
            else s.model = Model::one_sample;
        }
    }
    if (at != std::string_view::npos) s.counts = parse_counts(name, name.substr(at + 1));
    return checked(std::move(s));
}

Strategy parse_sample_strategy(std::string_view name)
{
    Strategy strategy = parse_strategy(name);
    if (strategy.model == Model::strata)
        refuse(name,
               "its samples come together, in rounds over a tile, and none stands by itself; "
               "the commands compare and render take it");
    return strategy;
}

}  // namespace mis
