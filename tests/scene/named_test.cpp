#include "mis/scene/named.h"

#include <gmock/gmock.h>

namespace mis {
namespace {

struct Apple {
    static constexpr std::string_view name = "apple";
    static constexpr int seeds = 5;
};
struct Cherry {
    static constexpr std::string_view name = "cherry";
    static constexpr int seeds = 1;
};
using Fruits = TypeList<Apple, Cherry>;

struct Entry {
    std::string name;
    int number;
};

constexpr int seeds_of(std::string_view name)
{
    int seeds = 0;
    visit_named(Fruits{}, name, [&]<class F>() { seeds += F::seeds; });
    return seeds;
}
static_assert(seeds_of("cherry") == 1 && seeds_of("apple") == 5 && seeds_of("plum") == 0);

TEST(Named, TypesAreVisitedByTheirNameAlone)
{
    EXPECT_TRUE(visit_named(Fruits{}, "apple", []<class F>() {}));
    for (const char* other : {"Apple", "appl", "", "apple "})
        EXPECT_FALSE(visit_named(Fruits{}, other, []<class F>() { FAIL(); })) << other;
    EXPECT_EQ(require_named(Fruits{}, "fruit", "cherry", []<class F>() { return F::seeds; }), 1);
}

TEST(Named, EntriesAreFoundByTheirNameAlone)
{
    const std::vector<Entry> list{{"one", 1}, {"two", 2}};
    EXPECT_EQ(find_named(list, "two"), &list[1]);
    EXPECT_EQ(find_named(list, "three"), nullptr);
    EXPECT_EQ(require_named(list, "number", "one").number, 1);
    EXPECT_THAT(names_in(list), testing::ElementsAre("one", "two"));
    EXPECT_THAT(names_in(Fruits{}), testing::ElementsAre("apple", "cherry"));
}

std::string refusal(auto look_up)
{
    try {
        look_up();
    } catch (const std::out_of_range& error) {
        return error.what();
    }
    return "";
}

TEST(Named, WhatIsNotThereIsRefusedWithAllNamesAndTheNearest)
{
    EXPECT_EQ(refusal([] {
                  require_named(Fruits{}, "fruit", "chery", []<class F>() { return F::seeds; });
              }),
              "found fruit \"chery\"; known are apple, cherry\n    Did you mean \"cherry\"?");
    EXPECT_EQ(refusal([] {
                  require_named(std::vector<Entry>{{"one", 1}}, "number", "seven");
              }),
              "found number \"seven\"; known are one");
}

}  // namespace
}  // namespace mis
