#include "mis/strategy/strategy.h"

#include "mis/strategy/names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace mis {
namespace {

using testing::HasSubstr;

const std::set<std::string> directions{"brdf", "cosine", "hemisphere"};

/// Every combination of registered names, models and a few counts; whether it has a meaning is for
/// checked() to say.
std::vector<Strategy> all_combinations()
{
    std::vector<Strategy> list;
    for (const Choosable& policy : policy_names())
        for (const Choosable& heuristic : heuristic_names())
            for (const Choosable& technique : technique_names())
                for (const Model model : {Model::multi, Model::one_sample})
                    for (const std::array<int, 2> counts :
                         {std::array{1, 1}, {1, 0}, {0, 1}, {4, 1}, {3, 2}, {4, 0}})
                        list.push_back(
                            {policy.name, heuristic.name, technique.name, model, counts});
    return list;
}

/// The rules once more, in the words of the contract.
bool has_meaning(const Strategy& s)
{
    const bool single = s.heuristic == "light", one_sample = s.model == Model::one_sample;
    if (directions.contains(s.technique)) return false;
    if (one_sample && (single || s.policy == "all" || s.counts != std::array{1, 1})) return false;
    return s.counts[0] > 0 && single == (s.counts[1] == 0);
}

/// What parse_strategy says against a name; "" if it takes it.
std::string refusal(std::string_view name)
{
    try {
        parse_strategy(name);
        return "";
    } catch (const StrategyError& error) {
        return error.what();
    }
}

TEST(Strategy, EveryCombinationWithAMeaningIsTakenAndItsNameComesBack)
{
    std::set<std::string> names;
    for (const Strategy& s : all_combinations()) {
        if (!has_meaning(s)) continue;
        EXPECT_NO_THROW(checked(s)) << name_of(s);
        EXPECT_EQ(parse_strategy(name_of(s)), s) << name_of(s);
        EXPECT_TRUE(names.insert(name_of(s)).second) << name_of(s) << " names two strategies";
    }
    EXPECT_GE(names.size(), 5U * 5 * 2);
}

TEST(Strategy, EveryCombinationWithoutAMeaningIsRefusedByName)
{
    int refused = 0;
    for (const Strategy& s : all_combinations()) {
        if (has_meaning(s)) continue;
        ++refused;
        try {
            checked(s);
            ADD_FAILURE() << name_of(s) << " is taken";
        } catch (const StrategyError& error) {
            EXPECT_THAT(error.what(), HasSubstr("\"" + name_of(s) + "\""))
                << "the message does not name the strategy";
        }
    }
    EXPECT_GT(refused, 0);
}

TEST(Strategy, TheDirectionsStandAlone)
{
    for (const std::string& name : directions) {
        const Strategy s = parse_strategy(name);
        EXPECT_FALSE(s.chooses_light());
        EXPECT_EQ(s.counts, (std::array{0, 1}));
        EXPECT_EQ(name_of(s), name);
    }
}

TEST(Strategy, NamesAreThoseOfTheContract)
{
    EXPECT_EQ(name_of({"solid-angle", "power"}), "solid-angle/power");
    EXPECT_EQ(name_of({"uniform", "light", "cone", Model::multi, {1, 0}}), "uniform/light");
    EXPECT_EQ(name_of({"power", "balance", "union"}), "power/balance/union");
    EXPECT_EQ(name_of({"power", "balance", "union", Model::one_sample}),
              "power/balance/union/one-sample");
    EXPECT_EQ(name_of({"power", "balance", "cone", Model::multi, {4, 1}}), "power/balance@4+1");
}

TEST(Strategy, WhatIsDefaultMayBeSaid)
{
    EXPECT_EQ(parse_strategy("power/balance/cone@1+1"), parse_strategy("power/balance"));
    EXPECT_EQ(parse_strategy("power/light/cone@1+0"), parse_strategy("power/light"));
    EXPECT_EQ(parse_strategy("brdf@0+1"), parse_strategy("brdf"));
}

TEST(Strategy, StrataStandsAloneWithItsDraws)
{
    for (const char* name : {"strata", "strata@1", "strata@64"})
        EXPECT_EQ(name_of(parse_strategy(name)), name);
    EXPECT_EQ(samples_together(parse_strategy("strata@64")), 64);
    EXPECT_EQ(samples_together(parse_strategy("product/light@64+0")), 1);
    EXPECT_EQ(parse_sample_strategy("brdf"), parse_strategy("brdf"));
    EXPECT_THROW(parse_sample_strategy("strata@64"), StrategyError);
}

struct Refusal {
    std::string_view name, reason;
};

TEST(Strategy, TheReasonOfARefusalIsSaid)
{
    for (const auto& [name, reason] : {
             Refusal{"uniform/brdf", "say \"brdf\""},
             {"uniform/cosine", "say \"cosine\""},
             {"uniform/light/one-sample", "\"light\" has only one"},
             {"all/balance/one-sample", "\"all\" draws for every light"},
             {"uniform/balance/one-sample@2+1", "has no counts"},
             {"uniform/balance/hemisphere", "say \"hemisphere\""},
             {"uniform/light@1+1", "say @1+0"},
             {"uniform/balance@1+0", "say \"uniform/light@1+0\""},
             {"uniform/balance@0+1", "say \"brdf\""},
             {"brdf@1+1", "has one draw"},
             {"cone", "name a policy"},
             {"power", "needs a heuristic: \"power/light\""},
             {"uniform/balance@", "@LIGHT+BSDF"},
             {"uniform/balance@4", "@LIGHT+BSDF"},
             {"uniform/balance@-1+1", "@LIGHT+BSDF"},
             {"uniform/balance@1+1+1", "@LIGHT+BSDF"},
             {"uniform/balance@99999999999+1", "@LIGHT+BSDF"},
             {"uniform/balance/one-sample/union", "the technique stands before \"one-sample\""},
             {"uniform/balance/cone/union", "one technique"},
             {"uniform/balance/one-sample/one-sample", "twice"},
             {"strata@", "1 to 65536"},
             {"strata@0", "1 to 65536"},
             {"strata@-4", "1 to 65536"},
             {"strata@4+1", "1 to 65536"},
             {"strata@65537", "1 to 65536"},
             {"strata/balance", "stands alone"},
         })
        EXPECT_THAT(refusal(name), HasSubstr(std::string(reason))) << name;
}

TEST(Strategy, AnUnknownNameGetsTheNearestAndTheList)
{
    for (const auto& [name, nearest] : {
             Refusal{"solid-angel/balance", "solid-angle"},
             {"powr/balance", "power"},
             {"uniform/balanse", "balance"},
             {"uniform/balance/unoin", "union"},
             {"uniform/balance/one-sampel", "one-sample"},
             {"hemisfere", "hemisphere"},
         }) {
        EXPECT_THAT(refusal(name), HasSubstr("Did you mean \"" + std::string(nearest) + "\"?"))
            << name;
        EXPECT_THAT(refusal(name), testing::AnyOf(HasSubstr("known are"), HasSubstr("or one of")))
            << name;
    }
    for (const std::string_view name :
         {"", "/", "//", "/balance", "uniform/", "uniform//", "zzzzzz/balance", "@1+1"})
        EXPECT_NE(refusal(name), "") << "\"" << name << "\" is taken";
}

TEST(Strategy, RankedByDefaultAreTheClassicsAndWhatKnowsMoreWhereItDiffers)
{
    using testing::ElementsAre;
    for (const std::size_t lights : {0, 1, 2, 32, 33, 1'000'000})
        for (const bool has_lobes : {false, true}) {
            std::vector<std::string> expected{"uniform", "power", "solid-angle",
                                              "radiant-solid-angle", "all"};
            if (has_lobes) expected.push_back("irradiance");
            expected.push_back("product");
            if (lights > 32) expected.push_back("tree");
            EXPECT_EQ(ranked_by_default(policy_names(), lights, has_lobes), expected);
            EXPECT_THAT(strategies_ranked_by_default(lights, has_lobes),
                        testing::UnorderedElementsAre("all/light/union", "product/light/projected",
                                                      "brdf"));
            EXPECT_THAT(ranked_by_default(heuristic_names(), lights, has_lobes),
                        ElementsAre("light", "balance", "power"));
            EXPECT_THAT(ranked_by_default(technique_names(), lights, has_lobes),
                        ElementsAre("brdf"));
        }
}

TEST(Strategy, RankedByDefaultMayDependOnTheScene)
{
    using testing::ElementsAre;
    const std::vector<Choosable> list{
        {"many", "", [](std::size_t lights, bool) { return lights > 32; }},
        {"glossy", "", [](std::size_t, bool has_lobes) { return has_lobes; }},
        {"silent", ""}};
    EXPECT_THAT(ranked_by_default(list, 32, false), ElementsAre());
    EXPECT_THAT(ranked_by_default(list, 33, false), ElementsAre("many"));
    EXPECT_THAT(ranked_by_default(list, 33, true), ElementsAre("many", "glossy"));
}

TEST(Strategy, EveryRegisteredNameHasASummaryAndIsListedOnce)
{
    for (const auto& list : {policy_names(), heuristic_names(), technique_names()}) {
        std::set<std::string> seen;
        for (const Choosable& c : list) {
            EXPECT_TRUE(seen.insert(c.name).second) << c.name;
            EXPECT_FALSE(c.summary.empty()) << c.name;
        }
    }
}

}  // namespace
}  // namespace mis
