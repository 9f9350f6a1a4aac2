#include "mis/io/report_html.h"

#include "mis/io/base64.h"
#include "mis/io/maps_exr.h"
#include "mis/io/page_assets.h"
#include "mis/io/report_json.h"
#include "mis/strategy/names.h"
#include "tests/io/sample_report.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>

namespace mis {
namespace {

/// What stands in the page's <script> of that id.
std::string block(const std::string& page, const std::string& id)
{
    const std::size_t name = page.find("id=\"" + id + "\">");
    if (name == std::string::npos) return "";
    const std::size_t begin = page.find('>', name) + 1;
    return page.substr(begin, page.find("</script>", begin) - begin);
}

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(ReportHtml, HoldsTheFiguresOfTheJson)
{
    const Report report = sample_report();
    const std::vector<std::optional<PagePictures>> none(report.scenes.size());
    const std::string page = report_html(report, none);
    EXPECT_EQ(nlohmann::json::parse(block(page, "report")),
              nlohmann::json::parse(report_json(report)));
    EXPECT_EQ(block(page, "maps"), "[null,\nnull]");
    EXPECT_EQ(page.find("@@"), page.npos);
    EXPECT_TRUE(page.ends_with("</html>\n"));
    for (const char* asset : {"d3.min.js", "style.css", "main.js"})
        EXPECT_NE(page.find(page_asset(asset)), page.npos) << asset;
}

/// Names that end a script, open a comment or turn the writing round stay data.
TEST(ReportHtml, KeepsHostileNamesInTheData)
{
    Report report = sample_report();
    const std::vector<std::optional<PagePictures>> none(report.scenes.size());
    const std::string before = report_html(report, none);
    const std::string hostile =
        "</script><script>alert(1)</script><!-- \"quotes\" & '\xE2\x80\xA8 \xE2\x80\xAE rtl "
        "@@script@@";
    report.scenes[0].name = report.command = hostile;
    const std::string page = report_html(report, none);
    EXPECT_EQ(count(page, "<script"), count(before, "<script"));
    EXPECT_EQ(count(page, "</script>"), count(before, "</script>"));
    EXPECT_EQ(count(page, "<!--"), count(before, "<!--"));
    EXPECT_EQ(count(page, "\xE2\x80\xA8"), 0U);
    EXPECT_EQ(nlohmann::json::parse(block(page, "report"))["scenes"][0]["name"], hostile);
}

TEST(ReportHtml, AsksForNothingOutsideItself)
{
    const std::string page =
        report_html(sample_report(), std::vector<std::optional<PagePictures>>(2));
    EXPECT_NE(page.find("default-src 'none'"), page.npos);
    for (const char* way_out : {"src=", "@import", "url(", "fetch(", "XMLHttpRequest", "<iframe"}) {
        std::size_t in_d3 = count(std::string(page_asset("d3.min.js")), way_out);
        if (std::string(way_out) == "url(")  // a clip of a plot, within the page
            in_d3 += count(std::string(page_asset("error_time.js")), "url(#");
        EXPECT_EQ(count(page, way_out), in_d3) << way_out;
    }
}

/// A new policy or heuristic is one file and one registry line: the page's sources name none.
TEST(ReportHtml, KnowsNoPolicyAndNoHeuristicByName)
{
    const std::string page =
        report_html(sample_report(), std::vector<std::optional<PagePictures>>(2));
    const std::size_t begin = page.find(page_asset("base.js"));
    const std::string script = page.substr(begin, page.find("</script>", begin) - begin);
    for (const auto& list : {policy_names(), heuristic_names()})
        for (const Choosable& c : list)
            for (const std::string& use :
                 {"{ " + c.name + ":", ", " + c.name + ":",
                  "{ \"" + c.name + "\":", ", \"" + c.name + "\":", "policy === \"" + c.name,
                  "heuristic === \"" + c.name, "heuristic." + c.name, "policy." + c.name})
                EXPECT_EQ(count(script, use), 0U) << use;
}

TEST(Base64, IsThatOfTheRfc)
{
    const std::vector<std::pair<std::string, std::string>> vectors{// RFC 4648, §10
                                                                   {"", ""},
                                                                   {"f", "Zg=="},
                                                                   {"fo", "Zm8="},
                                                                   {"foo", "Zm9v"},
                                                                   {"foob", "Zm9vYg=="},
                                                                   {"fooba", "Zm9vYmE="},
                                                                   {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

/// Two strategies on 6 × 4 pixels, of which the first is background and the last not a number.
Maps small_maps()
{
    Maps maps;
    maps.width = 6;
    maps.height = 4;
    maps.kind.assign(24, PixelKind::lit);
    maps.kind[0] = PixelKind::background;
    maps.reference.assign(24, Vec3<float>(0.5F));
    for (int s = 0; s < 2; ++s) {
        StrategyMap map{
            s, std::vector<Vec3<float>>(24, Vec3<float>(0.25F)), std::vector<float>(24, 2.0F), {}};
        if (s == 1) map.bad = {23};
        maps.strategies.push_back(map);
    }
    maps.policies = {"uniform", "solid-angle"};
    for (WinnerMap* map : {&maps.by_variance, &maps.by_efficiency}) {
        map->strategy.assign(24, -1);
        map->policy.assign(24, 1);
        map->strategy_wins.assign(7, 0.0);
        map->policy_wins = {0, 1};
    }
    maps.lights = {1, 6, 4, std::vector<std::array<LightShare, shown_lights>>(24)};
    for (auto& lights : maps.lights.lights) lights[0] = {2, 1.0F};
    maps.scene_lights.assign(3, make_light({1, 2, 3}, 0.5, Vec3<double>(7)));
    return maps;
}

TEST(PagePictures, SayWhatTheyHold)
{
    const PagePictures page = page_pictures(small_maps(), 1e6, "0-");
    const auto json = nlohmann::json::parse(page.json);
    EXPECT_EQ(json["width"], 6);
    EXPECT_EQ(json["scale"], 1);
    EXPECT_EQ(json["strategies"][0]["planes"], 4);
    EXPECT_EQ(json["strategies"][1]["planes"], 5);  // one more: where samples were no numbers
    EXPECT_EQ(json["lights"]["lights"]["2"]["radius"], 0.5);
    ASSERT_EQ(page.pictures.size(), 5U);  // reference, winners, lights, two strategies
    for (const auto& [id, base64] : page.pictures)
        EXPECT_EQ(base64.rfind("iVBORw0KGgo", 0), 0U) << id;  // a PNG
    // The only value of a layer is the lowest one of its code.
    EXPECT_NEAR(std::exp2(json["strategies"][0]["mean"]["low"].get<double>()), 0.25, 1e-6);
    EXPECT_NEAR(std::exp2(json["strategies"][0]["variance"]["low"].get<double>()), 2, 1e-6);
}

TEST(PagePictures, KeepAPixelThatIsNoNumberAmongOthersThatAre)
{
    const auto codes = [](const Maps& maps) {
        const PagePictures page = page_pictures(maps, 20, "");
        const auto json = nlohmann::json::parse(page.json);
        EXPECT_EQ(json["scale"], 2);
        return page.pictures;
    };
    const auto picture = [](const auto& pictures, const std::string& id) {
        for (const auto& [name, base64] : pictures)
            if (name == id) return base64;
        return std::string();
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Maps whole = small_maps(), one = whole, all = whole;
    one.strategies[0].mean[7].y = nan;  // one of the four of the first block
    one.reference[7].x = nan;
    for (const std::size_t i : {0U, 1U, 6U, 7U}) {
        all.strategies[0].mean[i] = Vec3<float>(nan);
        all.reference[i] = Vec3<float>(nan);
    }
    for (const char* id : {"0", "reference"}) {
        EXPECT_NE(picture(codes(one), id), picture(codes(whole), id)) << id;
        EXPECT_EQ(picture(codes(one), id), picture(codes(all), id)) << id;
    }
    // A variance that is not known (one sample alone) leaves those that are.
    Maps unknown = small_maps();
    unknown.strategies[0].variance[7] = nan;
    EXPECT_EQ(picture(codes(unknown), "0"), picture(codes(whole), "0"));
}

TEST(PagePictures, AreBounded)
{
    EXPECT_EQ(page_scale(256, 256, 16, 9e6), 1);
    EXPECT_EQ(page_scale(1920, 1080, 17, 9e6), 2);
    EXPECT_EQ(page_scale(8192, 8192, 1, 9e6), 4);
    EXPECT_EQ(page_scale(3, 1, 16, 1), 1);  // never to nothing
    EXPECT_EQ(nlohmann::json::parse(page_pictures(small_maps(), 20, "").json)["width"], 3);
}

TEST(MapsExr, NamesItsLayers)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "maps.exr").string();
    Report report = sample_report();
    write_maps_exr(report, 0, small_maps(), file);
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    ASSERT_GT(bytes.size(), 8U);
    EXPECT_EQ(std::memcmp(bytes.data(), "\x76\x2f\x31\x01", 4), 0);
    const std::string first = name_of(report.scenes[0].strategies[0].strategy);
    std::string layer = first;
    layer[layer.find('/')] = '.';
    for (const std::string& name :
         {std::string("reference.R"), layer + ".mean.B", layer + ".variance.Y",
          std::string("winner.ID"), std::string("winner_by_efficiency.policy"),
          std::string("kind.ID"), std::string("mis:command"), std::string("mis:seed"),
          "0 " + first})
        EXPECT_NE(bytes.find(name), bytes.npos) << name;
    EXPECT_EQ(bytes.find(layer + ".invalid.ID"), bytes.npos);
    EXPECT_THROW(write_maps_exr(report, 0, small_maps(), "/dev/full/maps.exr"), std::runtime_error);
}

}  // namespace
}  // namespace mis
