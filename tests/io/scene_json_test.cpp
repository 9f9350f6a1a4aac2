#include "mis/io/scene_json.h"

#include "mis/io/json_node.h"
#include "mis/io/scene_keys.h"
#include "tests/io/temporary_folder.h"
#include "tests/support/places.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

namespace mis {
namespace {

const std::string view = R"("camera":{"position":[0,1,5],"target":[0,1,0]})";
const std::string light = R"({"center":[0,4,0],"radius":1,"radiance":1})";

/// A scene of the usual camera and the given members ("lights" among them).
std::string scene_text(const std::string& members)
{
    return R"({"format":"mis-scene/1",)" + view + "," + members + "}";
}
std::string lit(const std::string& members)
{
    return scene_text(members + R"(,"lights":[)" + light + "]");
}
std::string with_light(const std::string& entry)
{
    return scene_text(R"("lights":[)" + entry + "]");
}

Scene parsed(const std::string& text) { return parse_scene(text, "plates.json"); }

std::string message_about_scene(const std::string& text,
                                const std::filesystem::path& file = "plates.json")
{
    try {
        parse_scene(text, file);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "accepted";
}

// ── what is read ──

TEST(SceneJson, ReadsEveryKindOfThing)
{
    const TemporaryFolder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("bulbs.csv", "x,y,z,radius,r,g,b\n5,6,7,0.5,1,2,3\n");
    const std::filesystem::path file = folder.write("all.json", R"({
        // a comment
        "$schema": "../docs/scene.schema.json", "format": "mis-scene/1", "name": "all", /* another */
        "camera": { "position": [0,2,15], "target": [0,1,0], "up": [0,10,0], "vertical_fov": 28, "resolution": [320, 200.0] },
        "probes": [ { "position": [1,2,3], "normal": [0,0,4], "outgoing": [3,0,4], "material": "metal" } ],
        "materials": {
            "floor": { "type": "lambert", "albedo": 0.5 },
            "plate": { "type": "blinn", "diffuse": 0.05, "specular": 0.6, "exponent": 5000 },
            "board": { "type": "lecture", "kd": 0.1, "ks": 1.0, "m": 100, "specular_probability": 0.25 },
            "metal": { "type": "ggx", "f0": [0.9,0.7,0.3], "alpha": 0.1 } },
        "surfaces": [
            { "type": "mesh", "file": "a.obj", "material": "plate", "transform": { "translate": [0,1,0], "rotate": [0,90,0], "scale": 2 } },
            { "type": "sphere", "center": [0,1,0], "radius": 1, "material": "metal" },
            { "type": "quad", "corner": [-9,0,-9], "edges": [[0,0,18],[18,0,0]], "material": "floor" } ],
        "lights": [
            { "center": [0,4,0], "radius": 0.25, "radiance": [10,20,30] },
            { "type": "sphere", "center": [1,4,0], "radius": 0.5, "power": 100 },
            { "type": "table", "file": "bulbs.csv" },
            { "type": "random", "count": 10, "seed": 1, "box": [[-9,3,-9],[9,6,9]], "radius": [0.01,0.1], "power": [1,1000] } ] })");
    const Scene scene = read_scene(file);
    EXPECT_EQ(scene.file, file.string());
    EXPECT_EQ(scene.name, "all");
    EXPECT_EQ(scene.camera->up, (Vec3<double>{0, 1, 0}));
    EXPECT_EQ(scene.camera->vertical_fov_degrees, 28);
    EXPECT_EQ(scene.camera->resolution, (std::array{320, 200}));

    ASSERT_EQ(scene.probes.size(), 1u);
    EXPECT_EQ(scene.probes[0].position, (Vec3<double>{1, 2, 3}));
    EXPECT_EQ(scene.probes[0].normal, (Vec3<double>{0, 0, 1}));
    EXPECT_NEAR(length(scene.probes[0].outgoing - Vec3<double>(0.6, 0, 0.8)), 0, 1e-15);
    EXPECT_EQ(scene.materials.at(scene.probes[0].material).name, "metal");

    ASSERT_EQ(scene.materials.size(), 4u);
    const auto material = [&](const std::string& name) {
        for (const Material& m : scene.materials)
            if (m.name == name) return m;
        return Material{};
    };
    EXPECT_EQ(material("floor").diffuse, Vec3<double>(0.5));
    EXPECT_EQ(material("plate").exponent, 5000);
    EXPECT_EQ(material("board").diffuse, Vec3<double>(0.1));
    EXPECT_EQ(material("board").specular, Vec3<double>(1));
    EXPECT_EQ(material("board").exponent, 100);
    EXPECT_EQ(material("board").specular_probability, 0.25);
    EXPECT_EQ(material("metal").diffuse, Vec3<double>(0));
    EXPECT_EQ(material("metal").specular, (Vec3<double>{0.9, 0.7, 0.3}));
    EXPECT_EQ(material("metal").alpha, 0.1);
    EXPECT_FALSE(material("metal").specular_probability);

    ASSERT_EQ(scene.surfaces.size(), 3u);
    const Mesh& mesh = std::get<Mesh>(scene.surfaces[0].shape);
    EXPECT_EQ(mesh.positions[1], (Vec3<double>{0, 1, -2}));
    EXPECT_EQ(scene.materials.at(scene.surfaces[0].material).name, "plate");
    EXPECT_EQ(std::get<SphereSurface>(scene.surfaces[1].shape).center, (Vec3<double>{0, 1, 0}));
    EXPECT_EQ(std::get<Quad>(scene.surfaces[2].shape).edges[1], (Vec3<double>{18, 0, 0}));

    ASSERT_EQ(scene.lights.size(), 13u);
    EXPECT_EQ(radiance(scene.lights[0]), (Vec3<double>{10, 20, 30}));
    EXPECT_NEAR(radiance(scene.lights[1]).x, 100 / (std::pow(2 * 3.14159265358979, 2) * 0.25),
                1e-5);
    EXPECT_EQ(scene.lights[2].center, (Vec3<double>{5, 6, 7}));
}

TEST(JsonDocument, HandsOutTheStreamedListAndDoesNotKeepIt)
{
    std::vector<std::string> seen;
    const auto sink = [&](const Json&, std::size_t index, const Json& element) {
        seen.push_back(fmt::format("{}:{}", index, element.dump()));
    };
    const Json document = parse_json(R"({"a":{"list":[1]},"list":[[2,3],{"list":[4]},5],"b":[6]})",
                                     "a.json", "list", sink);
    EXPECT_EQ(seen, (std::vector<std::string>{"0:[2,3]", "1:{\"list\":[4]}", "2:5"}));
    EXPECT_EQ(document.dump(), R"({"a":{"list":[1]},"b":[6],"list":[]})");
}

TEST(SceneJson, TakesTheFilesNameForASceneWithoutOne)
{
    EXPECT_EQ(parse_scene(lit(R"("surfaces":[])"), "some/where/my room.json").name, "my room");
}

TEST(SceneJson, NormalisesOnlyDirectionsHoweverLong)
{
    const Scene scene = parsed(scene_text(R"("materials":{"m":{"type":"lambert","albedo":1}},
        "probes":[{"position":[0,0,0],"normal":[0,1e-200,0],"outgoing":[0,3e300,4e300],"material":"m"}],
        "surfaces":[{"type":"quad","corner":[0,0,0],"edges":[[0,0,7],[7,0,0]],"material":"m"}],"lights":[)" +
                                          light + "]"));
    EXPECT_EQ(scene.probes[0].normal, (Vec3<double>{0, 1, 0}));
    EXPECT_NEAR(scene.probes[0].outgoing.y, 0.6, 1e-15);
    EXPECT_EQ(std::get<Quad>(scene.surfaces[0].shape).edges[0], (Vec3<double>{0, 0, 7}));
}

TEST(SceneJson, KeepsTinyLightsOfGivenPower)
{
    const Scene scene = parsed(with_light(R"({"center":[0,4,0],"radius":1e-30,"power":100})"));
    EXPECT_NEAR(double(scene.lights[0].radiance_radius.x) / (100 / (4 * 9.8696044 * 1e-30)), 1,
                1e-6);
}

TEST(SceneJson, AcceptsACameraOrProbesAlone)
{
    const std::string probe =
        R"({"format":"mis-scene/1","materials":{"m":{"type":"lambert","albedo":1}},
        "probes":[{"position":[0,0,0],"normal":[0,1,0],"outgoing":[0,1,0],"material":"m"}],"lights":[)" +
        light + "]}";
    EXPECT_FALSE(parsed(probe).camera);
    EXPECT_TRUE(parsed(with_light(light)).probes.empty());
}

TEST(SceneJson, ReadsEveryShippedScene)
{
    int scenes = 0;
    std::uintmax_t bytes = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(source_dir() / "scenes")) {
        if (entry.is_regular_file()) bytes += entry.file_size();
        if (entry.path().extension() != ".json") continue;
        ++scenes;
        Scene scene;
        ASSERT_NO_THROW(scene = read_scene(entry.path())) << entry.path();
        EXPECT_TRUE(scene.camera) << entry.path();
        EXPECT_FALSE(scene.surfaces.empty()) << entry.path();
        EXPECT_EQ(scene.name, entry.path().stem().string());
    }
    EXPECT_GE(scenes, 10);
    EXPECT_LE(bytes, 1'000'000u);
}

TEST(SceneJson, ReadsTheExampleOfTheDocumentation)
{
    std::ifstream stream(source_dir() / "docs/scene-format.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t start = page.find("```jsonc\n") + 9, end = page.find("```", start);
    ASSERT_LT(end, page.size());
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "meshes");
    folder.write("meshes/plate.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("bulbs.csv", "x,y,z,radius,r,g,b\n5,6,7,0.5,1,2,3\n");
    EXPECT_NO_THROW(read_scene(
        folder.write("example.json", std::string_view(page).substr(start, end - start))));
}

// ── random lights ──

TEST(RandomLights, AreTheSameOnEveryMachine)
{
    const Scene scene = parsed(with_light(
        R"({"type":"random","count":3,"seed":1,"box":[[-9,3,-9],[9,6,9]],"radius":[0.01,0.1],"power":[1,1000]})"));
    const Light& last = scene.lights.at(2);
    EXPECT_EQ(last.center,
              (Vec3<double>{-1.7254409570959375, 4.816261106925987, -0.8111176655347876}));
    EXPECT_EQ(last.radius, 0.033890579697863445);
    EXPECT_EQ(last.radiance_radius.x, 15.186492f);
}

TEST(RandomLights, HaveTheStatedDistributionsIndependently)
{
    constexpr int count = 100'000;
    const double tolerance =
        6 / std::sqrt(double{count});  // six standard errors of a correlation: 2e-9 each
    const Scene scene = parsed(with_light(
        R"({"type":"random","count":100000,"seed":7,"box":[[-9,103,-9],[9,106,9]],"radius":[0.01,10],"power":[1e-3,1e3]})"));
    ASSERT_EQ(scene.lights.size(), std::size_t{count});
    // Each as a uniform number in [−√3, √3], of mean 0 and variance 1.
    std::vector<std::array<double, 5>> numbers;
    for (const Light& l : scene.lights) {
        const double power = radiance(l).x * l.radius * l.radius * 4 * 9.869604401089358;
        const std::array<double, 5> u{(l.center.x + 9) / 18, (l.center.y - 103) / 3,
                                      (l.center.z + 9) / 18, std::log10(l.radius / 0.01) / 3,
                                      std::log10(power / 1e-3) / 6};
        std::array<double, 5> scaled;
        for (int i = 0; i < 5; ++i) {
            ASSERT_GE(u[i], -1e-7);
            ASSERT_LE(u[i], 1 + 1e-7);
            scaled[i] = (2 * u[i] - 1) * std::sqrt(3.0);
        }
        numbers.push_back(scaled);
    }
    for (int a = 0; a < 5; ++a)
        for (int b = a; b < 5; ++b) {
            double product = 0, mean = 0;
            for (const auto& n : numbers) product += n[a] * n[b] / count, mean += n[a] / count;
            EXPECT_NEAR(product, a == b ? 1 : 0, tolerance) << a << " " << b;
            EXPECT_NEAR(mean, 0, tolerance) << a;
        }
}

TEST(RandomLights, DependOnTheSeedAlone)
{
    const auto first = [](const std::string& seed, const std::string& count) {
        return parsed(with_light(R"({"type":"random","count":)" + count + R"(,"seed":)" + seed +
                                 R"(,"box":[[0,3,0],[1,4,1]],"radius":[0.01,0.1],"power":[1,10]})"))
            .lights.at(0)
            .center;
    };
    EXPECT_EQ(first("5", "1"), first("5", "9"));
    EXPECT_NE(first("5", "1"), first("6", "1"));
    EXPECT_NE(first("18446744073709551615", "1"),
              first("18446744073709551614", "1"));  // 64 bits, not a double's 53
}

TEST(RandomLights, OfARangeOfOneValueHaveIt)
{
    const Scene scene = parsed(with_light(
        R"({"type":"random","count":5,"seed":1,"box":[[1,3,1],[1,3,1]],"radius":[0.3,0.3],"power":[7,7]})"));
    for (const Light& l : scene.lights) {
        EXPECT_EQ(l.center, (Vec3<double>{1, 3, 1}));
        EXPECT_EQ(l.radius, 0.3);
    }
}

// ── what is wrong ──

struct BadScene {
    const char* name;
    std::string text, message;  ///< the message's first words; "…" of its end may be left out
};

void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

class EveryBadScene : public testing::TestWithParam<BadScene> {};

TEST_P(EveryBadScene, GivesOneMessageWithItsPlace)
{
    const std::string message = message_about_scene(GetParam().text);
    EXPECT_EQ(message.substr(0, GetParam().message.size()), GetParam().message);
    EXPECT_NE(message.find("; "), message.npos) << "what is allowed";
    EXPECT_NE(message.find("\n    "), message.npos) << "what to do";
}

const std::string random_start = R"({"type":"random","count":2,"seed":1,"box":[[0,3,0],[1,4,1]],)";
const std::string grey_lambert = R"("materials":{"floor":{"type":"lambert","albedo":0.5}})";
const std::string known_materials = "; the scene's materials are floor";
const std::string range_allowed = "; two numbers, [low, high], 0 < low <= high, belong here";

const BadScene bad_scenes[] = {
    // the text
    {"Cut", "{", "plates.json: line 1, column 2: found the end of the text; this is not JSON ("},
    {"CommaBeforeBrace", "{\n  \"format\": \"mis-scene/1\",\n}",
     "plates.json: line 3, column 1: found \"}\"; this is not JSON (while parsing object key - "
     "unexpected '}'; expected string literal)\n    Remove the comma before it."},
    {"CommaBeforeBracket", R"({"a":[1,]})",
     "plates.json: line 1, column 9: found \"]\"; this is not JSON ("},
    {"CommaMissing", "{\"a\": 1\n \"b\": 2}",
     "plates.json: line 2, column 4: found \"\\\"b\\\"\"; this is not JSON ("},
    {"NoWord", R"({"a": truw})",
     "plates.json: line 1, column 10: found \"truw\"; this is not JSON ("},
    {"Nan", R"({"a": NaN})",
     "plates.json: line 1, column 7: found \"NaN\"; NaN is no JSON number\n    Write a finite "
     "number, or leave the key out."},
    {"SmallNan", R"({"a": nan})",
     "plates.json: line 1, column 7: found \"nan\"; nan is no JSON number"},
    {"Infinity", R"({"a": Infinity})",
     "plates.json: line 1, column 7: found \"Infinity\"; Infinity is no JSON number"},
    {"MinusInfinity", R"({"a": [1, -Infinity]})",
     "plates.json: line 1, column 11: found \"-Infinity\"; -Infinity is no JSON number"},
    {"Inf", R"({"a": inf})", "plates.json: line 1, column 7: found \"inf\"; inf is no JSON number"},
    {"WordOfPython", R"({"a": True})",
     "plates.json: line 1, column 7: found \"True\"; JSON writes true, false and null, in small "
     "letters\n    Write true."},
    {"NoneOfPython", R"({"a": None})",
     "plates.json: line 1, column 7: found \"None\"; JSON writes true, false and null, in small "
     "letters\n    Write null."},
    {"SingleQuotes", R"({'a': 1})",
     "plates.json: line 1, column 2: found a single quote, '; strings and keys stand in double "
     "quotes"},
    {"KeyWithoutQuotes", R"({radius : 1})",
     "plates.json: line 1, column 2: found \"radius\"; a key stands in double quotes\n    Write "
     "\"radius\"."},
    {"TypographicQuotes", "{\"a\": \u201Cb\u201D}",
     "plates.json: line 1, column 7: found the character U+201C, a typographic quote; between its "
     "strings JSON has plain ASCII characters alone\n    Write \" in its place."},
    {"NoBreakSpace", "{\"a\":\u00A01}",
     "plates.json: line 1, column 6: found the character U+00A0, a no-break space; between its "
     "strings JSON has plain ASCII characters alone\n    Remove it, or type it again."},
    {"ZeroWidthSpace", "{\"a\": 1\u200B}",
     "plates.json: line 1, column 8: found the character U+200B, a zero-width space; "},
    {"MarkWithin", "{\"a\": 1,\n\uFEFF\"b\": 1}",
     "plates.json: line 2, column 1: found the character U+FEFF, a byte order mark; "},
    {"TypographicMinus", "{\"a\": \u22121}",
     "plates.json: line 1, column 7: found the character U+2212, a minus sign that is no hyphen; "},
    {"CommentOfPython", "{ # lamps\n}",
     "plates.json: line 1, column 3: found \"#\"; a comment begins with // or /*"},
    {"LeadingZero", R"({"a": 01})",
     "plates.json: line 1, column 7: found \"01\"; a JSON number has no zero before its first "
     "digit"},
    {"Plus", R"({"a": +1})",
     "plates.json: line 1, column 7: found \"+1\"; a JSON number has no + before it"},
    {"PointFirst", R"({"a": .5})",
     "plates.json: line 1, column 7: found \".5\"; a JSON number has digits on both sides of its "
     "point"},
    {"PointLast", R"({"a": 5.})",
     "plates.json: line 1, column 7: found \"5.\"; a JSON number has digits on both sides"},
    {"Hexadecimal", R"({"a": 0x10})",
     "plates.json: line 1, column 7: found \"0x10\"; JSON has no hexadecimal numbers"},
    {"NumberOfC", R"({"a": 1.0f})",
     "plates.json: line 1, column 7: found \"1.0f\"; a JSON number has digits, a point and an "
     "exponent alone"},
    {"NumberWithUnderscore", R"({"a": 1_000})",
     "plates.json: line 1, column 7: found \"1_000\"; a JSON number has digits, a point"},
    {"NumberOfFortran", R"({"a": 1d3})",
     "plates.json: line 1, column 7: found \"1d3\"; a JSON number has digits, a point"},
    {"ExponentWithoutDigits", R"({"a": 1e})",
     "plates.json: line 1, column 7: found \"1e\"; a JSON number has digits, a point"},
    {"NanOfOldLibraries", R"({"a": -1.#IND00})",
     "plates.json: line 1, column 7: found \"-1.#IND00\"; -1.#IND00 is no JSON number"},
    {"DecimalComma", R"({"a": 0,5})",
     "plates.json: line 1, column 9: found \"5\"; a key, in double quotes, belongs here\n    Write "
     "0.5, not 0,5"},
    {"StringCutOff", R"({"a": "bc)",
     "plates.json: line 1, column 10: found the end of the text within a string; a string ends "
     "with \" on the line on which it begins"},
    {"PathWithBackslash", R"({"file": "C:\lamps.csv"})",
     R"(plates.json: line 1, column 13: found "\\l"; in a string a backslash is written \\; it begins )"},
    {"PathOfAUser", R"({"file": "C:\users\x.csv"})",
     R"(plates.json: line 1, column 13: found "\\us"; in a string a backslash is written \\; )"},
    {"PathEndsInBackslash", "{\"file\": \"C:\\\",\n\"a\": 1}",
     "plates.json: line 1, column 16: found the end of the line within a string; a string ends "
     "with "
     "\" on the line on which it begins\n    In \\\" the quote is part of the text."},
    {"PathEndsInBackslashOnOneLine", R"({"file": "C:\", "a": 1})",
     R"(plates.json: line 1, column 18: found "a"; )"},
    {"PathWithATab", with_light(R"({"type":"table","file":"C:\table.csv"})"),
     R"(plates.json: /lights/0/file: found "C:\table.csv", which has a control character in it; )"},
    {"StringWithoutEnd", "{\"a\": \"b\n}",
     "plates.json: line 1, column 9: found the end of the line within a string; a string ends with "
     "\" on the line on which it begins\n    Close it with \"."},
    {"HalfACharacter", R"({"a": "\uD83D!"})",
     R"(plates.json: line 1, column 8: found "\\uD83D!"; \uD800 to \uDFFF are halves of one )"},
    {"Utf16", std::string("\xFF\xFE{\0}\0", 6),
     "plates.json: found UTF-16 text (little-endian); the text is UTF-8, without zero bytes\n    "
     "Save it as UTF-8."},
    {"Utf16WithoutAMark", std::string("\0{\0}", 4),
     "plates.json: found UTF-16 text (big-endian); "},
    {"Utf32", std::string("\0\0\xFE\xFF\0\0\0{", 8),
     "plates.json: found UTF-32 text (big-endian); "},
    {"Packed", "\x1F\x8B\x08", "plates.json: found a gzip file; "},
    {"LinesOfOldMacs", "{\r\"a\": 1,\r\"b\": x}",
     "plates.json: line 3, column 6: found \"x\"; this is not JSON ("},
    {"NotUtf8", "{\n\"a\": \"\xFF\"}",
     "plates.json: line 2, column 7: found byte 0xFF; the text is UTF-8"},
    {"OverlongUtf8", "{\"a\": \"\xC0\xAF\"}",
     "plates.json: line 1, column 8: found byte 0xC0; the text is UTF-8"},
    {"ZeroByte", std::string("{}\0 rest", 8),
     "plates.json: line 1, column 3: found byte 0x00; the text is UTF-8, without zero bytes"},
    {"TextAfterwards", "{} x", "plates.json: line 1, column 4: found \"x\"; this is not JSON ("},
    {"KeyTwice", R"({"camera":{"position":[0,0,0],"target":[1,0,0],"position":[1,1,1]}})",
     "plates.json: /camera/position: found the key \"position\" a second time; a key is given "
     "once\n    Remove one of the two."},
    {"FirstOfTwoErrors", R"({"lights":[{"radius":1},{"radius":1,"radius":2}]})",
     "plates.json: /lights/0: found neither"},
    {"KeyTwiceInTheSecondLight", with_light(light + R"(,{"radius":1,"radius":2})"),
     "plates.json: /lights/1/radius: found the key \"radius\" a second time"},
    {"KeyTwiceInTheFirstLight", R"({"lights":[{"radius":1,"radius":2}]})",
     "plates.json: /lights/0/radius: found the key \"radius\" a second time"},
    {"KeyTwiceEscaped", R"({"materials":{"a/b":1,"a\u002fb":2}})",
     "plates.json: /materials/a~1b: found the key \"a/b\" a second time"},
    {"NumberTooLarge", R"({"probes":[0,{"position":[0,1e999,0]}]})",
     "plates.json: /probes/1/position/1: found 1e999; a number lies within the range of a double"},
    {"NumberTooSmall", R"({"camera":{"vertical_fov":1e-999}})",
     "plates.json: /camera/vertical_fov: found 1e-999; a number lies within the range of a double"},
    {"NestedTooDeep", R"({"a":)" + std::string(100'000, '['), "plates.json: /a/0/0/0/0/"},
    {"NoObject", "[1, 2]", "plates.json: found [1,2]; an object, { ... }, belongs here"},
    // format and keys
    {"NoFormat", "{" + view + R"(,"lights":[)" + light + "]}",
     "plates.json: /format: found nothing; \"format\" is required here"},
    {"OtherFormat", R"({"format":"mis-scene/2","lights":[{"shape":"cube"}]})",
     "plates.json: /format: found \"mis-scene/2\"; this version reads \"mis-scene/1\""},
    {"FormatNoString", R"({"format":1})",
     "plates.json: /format: found 1; a string, in double quotes, belongs here"},
    {"UnknownKey", lit(R"("surface":[])"),
     "plates.json: /surface: found the unknown key \"surface\"; known keys are $schema, format, "
     "name, camera, probes, materials, surfaces, lights\n    Did you mean \"surfaces\"?"},
    {"UnknownKeyUnlikeAny", lit(R"("fog":1)"),
     "plates.json: /fog: found the unknown key \"fog\"; known keys are $schema, format, name, "
     "camera, probes, materials, surfaces, lights\n    Remove it."},
    {"UnknownKeyOfLight", with_light(R"({"center":[0,4,0],"radios":1,"radiance":1})"),
     "plates.json: /lights/0/radios: found the unknown key \"radios\"; known keys are type, "
     "center, radius, radiance, power\n    Did you mean \"radius\"?"},
    {"NameNoString", lit(R"("name":["a"])"),
     "plates.json: /name: found [\"a\"]; a string, in double quotes, belongs here"},
    {"ControlCharacters", lit(R"("a\u001b[31m\n":1)"),
     "plates.json: /a\\u001b[31m\\u000a: found the unknown key"},
    // camera and probes
    {"NoCameraNoProbes", R"({"format":"mis-scene/1","lights":[)" + light + "]}",
     "plates.json: /camera: found neither a camera nor probes; a scene has a camera, or probes, or "
     "both"},
    {"CameraWithoutTarget",
     R"({"format":"mis-scene/1","camera":{"position":[0,0,0]},"lights":[)" + light + "]}",
     "plates.json: /camera/target: found nothing; \"target\" is required here"},
    {"PositionTooShort",
     R"({"format":"mis-scene/1","camera":{"position":[0,0]},"lights":[)" + light + "]}",
     "plates.json: /camera/position: found [0,0]; three numbers, [x, y, z], belong here"},
    {"PositionOfStrings",
     R"({"format":"mis-scene/1","camera":{"position":[0,"1",0]},"lights":[)" + light + "]}",
     "plates.json: /camera/position/1: found \"1\"; a number belongs here"},
    {"UpZero",
     R"({"format":"mis-scene/1","camera":{"position":[0,0,0],"target":[1,0,0],"up":[0,0,0]},"lights":[)" +
         light + "]}",
     "plates.json: /camera/up: found [0, 0, 0]; up is a direction: finite numbers, not all 0"},
    {"ResolutionZero",
     R"({"format":"mis-scene/1","camera":{"position":[0,0,0],"target":[1,0,0],"resolution":[0,9]},"lights":[)" +
         light + "]}",
     "plates.json: /camera/resolution: found [0, 9]; width and height lie between 1 and 16384 "
     "pixels"},
    {"ResolutionBroken",
     R"({"format":"mis-scene/1","camera":{"position":[0,0,0],"target":[1,0,0],"resolution":[9.5,9]},"lights":[)" +
         light + "]}",
     "plates.json: /camera/resolution/0: found 9.5; a whole number between 1 and 16384 belongs "
     "here"},
    {"ResolutionOfOne",
     R"({"format":"mis-scene/1","camera":{"position":[0,0,0],"target":[1,0,0],"resolution":256},"lights":[)" +
         light + "]}",
     "plates.json: /camera/resolution: found 256; two whole numbers, [width, height], belong here"},
    {"CameraInLight", with_light(R"({"center":[0,1,5],"radius":1,"radiance":1})"),
     "plates.json: /camera/position: found [0, 1, 5], inside light 0 (counted from 0; center [0, "
     "1, 5], radius 1); a camera stands outside all lights"},
    {"ProbeWithoutOutgoing",
     lit(grey_lambert + R"(,"probes":[{"position":[0,0,0],"normal":[0,1,0],"material":"floor"}])"),
     "plates.json: /probes/0/outgoing: found nothing; \"outgoing\" is required here"},
    {"ProbeNormalZero",
     lit(grey_lambert +
         R"(,"probes":[{"position":[0,0,0],"normal":[0,0,0],"outgoing":[0,1,0],"material":"floor"}])"),
     "plates.json: /probes/0/normal: found [0, 0, 0]; a direction is not the zero vector"},
    {"ProbesNoArray", lit(R"("probes":{})"),
     "plates.json: /probes: found an empty object; an array, [ ... ], belongs here"},
    // materials
    {"MaterialTypeUnknown", lit(R"("materials":{"floor":{"type":"lamber","albedo":1}})"),
     "plates.json: /materials/floor/type: found \"lamber\"; known types are lambert, lecture, "
     "blinn, ggx\n    Did you mean \"lambert\"?"},
    {"MaterialWithoutType", lit(R"("materials":{"floor":{"albedo":1}})"),
     "plates.json: /materials/floor/type: found nothing; \"type\" is required here"},
    {"MaterialFieldMissing", lit(R"("materials":{"floor":{"type":"ggx","alpha":1}})"),
     "plates.json: /materials/floor/f0: found nothing; \"f0\" is required here"},
    {"MaterialFieldOfOtherType",
     lit(R"("materials":{"floor":{"type":"ggx","alpha":1,"f0":1,"albedo":1}})"),
     "plates.json: /materials/floor/albedo: found the unknown key \"albedo\"; known keys are type, "
     "diffuse, f0, alpha, specular_probability"},
    {"LambertHasNoLobeToChoose",
     lit(R"("materials":{"floor":{"type":"lambert","albedo":1,"specular_probability":1}})"),
     "plates.json: /materials/floor/specular_probability: found the unknown key"},
    {"AlbedoTooLarge", lit(R"("materials":{"floor":{"type":"lambert","albedo":[0,1.5,0]}})"),
     "plates.json: /materials/floor/albedo: found [0, 1.5, 0]; albedo lies between 0 and 1"},
    {"AlbedoOfTwo", lit(R"("materials":{"floor":{"type":"lambert","albedo":[0,1]}})"),
     "plates.json: /materials/floor/albedo: found [0,1]; a number, or three, [r, g, b], belong "
     "here"},
    {"AlphaZero", lit(R"("materials":{"floor":{"type":"ggx","alpha":0,"f0":1}})"),
     "plates.json: /materials/floor/alpha: found 0; alpha is greater than 0 and at most 1"},
    {"ProbabilityTooLarge",
     lit(R"("materials":{"floor":{"type":"ggx","alpha":1,"f0":1,"specular_probability":2}})"),
     "plates.json: /materials/floor/specular_probability: found 2; a probability lies between 0 "
     "and 1"},
    {"MaterialsNoObject", lit(R"("materials":[])"),
     "plates.json: /materials: found []; an object, { ... }, belongs here"},
    // surfaces
    {"MaterialUnknown",
     lit(grey_lambert +
         R"(,"surfaces":[{"type":"sphere","center":[0,0,0],"radius":1,"material":"flor"}])"),
     "plates.json: /surfaces/0/material: found \"flor\"" + known_materials +
         "\n    Did you mean \"floor\"?"},
    {"MaterialMissingAltogether",
     lit(R"("surfaces":[{"type":"sphere","center":[0,0,0],"radius":1,"material":"floor"}])"),
     "plates.json: /surfaces/0/material: found \"floor\"; the scene has no materials\n    Add it "
     "to \"materials\"."},
    {"SurfaceTypeUnknown", lit(R"("surfaces":[{"type":"squad"}])"),
     "plates.json: /surfaces/0/type: found \"squad\"; known types are mesh, sphere, quad\n    Did "
     "you mean \"quad\"?"},
    {"SurfaceRadiusNegative",
     lit(grey_lambert +
         R"(,"surfaces":[{"type":"sphere","center":[0,0,0],"radius":-0.5,"material":"floor"}])"),
     "plates.json: /surfaces/0/radius: found -0.5; a radius is greater than 0"},
    {"QuadOfOneEdge",
     lit(grey_lambert +
         R"(,"surfaces":[{"type":"quad","corner":[0,0,0],"edges":[[0,0,1]],"material":"floor"}])"),
     "plates.json: /surfaces/0/edges: found an array of 1; two edges, "},
    {"QuadDegenerate",
     lit(grey_lambert +
         R"(,"surfaces":[{"type":"quad","corner":[0,0,0],"edges":[[0,0,1],[0,0,2]],"material":"floor"}])"),
     "plates.json: /surfaces/0/edges: found [[0, 0, 1], [0, 0, 2]]; a quad's two edges have a "
     "length and are not parallel"},
    {"MeshMissing",
     lit(grey_lambert + R"(,"surfaces":[{"type":"mesh","file":"nothing.obj","material":"floor"}])"),
     "plates.json: /surfaces/0/file: found \"nothing.obj\", which does not exist; a path is "
     "relative to the scene file's folder"},
    {"MeshIsAFolder",
     lit(grey_lambert + R"(,"surfaces":[{"type":"mesh","file":".","material":"floor"}])"),
     "plates.json: /surfaces/0/file: found \".\", which is a directory or a device; "},
    {"MeshNameEmpty",
     lit(grey_lambert + R"(,"surfaces":[{"type":"mesh","file":"","material":"floor"}])"),
     "plates.json: /surfaces/0/file: found \"\"; a path is relative"},
    {"MeshNameWithZero",
     lit(grey_lambert + R"(,"surfaces":[{"type":"mesh","file":"a\u0000b","material":"floor"}])"),
     "plates.json: /surfaces/0/file: found \"a\\u0000b\"; a path is relative"},
    {"ScaleZero",
     lit(grey_lambert +
         R"(,"surfaces":[{"type":"mesh","file":"a.obj","material":"floor","transform":{"scale":[1,0,1]}}])"),
     "plates.json: /surfaces/0/transform/scale: found [1,0,1]; a scale is not 0"},
    {"TransformKeyUnknown",
     lit(grey_lambert +
         R"(,"surfaces":[{"type":"mesh","file":"a.obj","material":"floor","transform":{"rotation":[1,0,1]}}])"),
     "plates.json: /surfaces/0/transform/rotation: found the unknown key \"rotation\"; known keys "
     "are translate, rotate, scale\n    Did you mean \"rotate\"?"},
    // lights
    {"NoLights", scene_text(R"("lights":[])"),
     "plates.json: /lights: found no lights; a scene has between 1 and 10000000 lights"},
    {"LightsLeftOut", scene_text(R"("surfaces":[])"), "plates.json: /lights: found no lights; "},
    {"LightsNoArray", scene_text(R"("lights":{"a":1})"),
     "plates.json: /lights: found an object; an array, [ ... ], belongs here"},
    {"LightNoObject", with_light(light + ",3"),
     "plates.json: /lights/1: found 3; an object, { ... }, belongs here"},
    {"LightTypeUnknown", with_light(R"({"type":"tabel"})"),
     "plates.json: /lights/0/type: found \"tabel\"; known types are sphere, table, random\n    Did "
     "you mean \"table\"?"},
    {"LightRadiusNegative", with_light(light + R"(,{"center":[0,4,0],"radius":-0.5,"radiance":1})"),
     "plates.json: /lights/1/radius: found -0.5; a radius is greater than 0"},
    {"LightRadiusMissing", with_light(R"({"center":[0,4,0],"radiance":1})"),
     "plates.json: /lights/0/radius: found nothing; \"radius\" is required here"},
    {"LightWithBoth", with_light(R"({"center":[0,4,0],"radius":1,"radiance":1,"power":1})"),
     "plates.json: /lights/0: found both \"radiance\" and \"power\"; a light has one of "
     "\"radiance\" and \"power\""},
    {"LightWithNeither", with_light(R"({"center":[0,4,0],"radius":1})"),
     "plates.json: /lights/0: found neither \"radiance\" nor \"power\"; a light has one of"},
    {"PowerNegative", with_light(R"({"center":[0,4,0],"radius":1,"power":[1,-2,3]})"),
     "plates.json: /lights/0/power: found [1, -2, 3]; a power is finite and not negative"},
    {"RadianceTooLarge", with_light(R"({"center":[0,4,0],"radius":1e10,"radiance":1e30})"),
     "plates.json: /lights/0/radiance: found 1e+30, for a radius of 1e+10; radiance times radius "
     "is 0, or lies between 1e-37 and 1e+37"},
    {"TableMissing", with_light(R"({"type":"table","file":"nothing.csv"})"),
     "plates.json: /lights/0/file: found \"nothing.csv\", which does not exist; a path is "
     "relative"},
    {"RandomCountBroken",
     with_light(
         R"({"type":"random","count":1.5,"seed":1,"box":[[0,3,0],[1,4,1]],"radius":[1,2],"power":[1,2]})"),
     "plates.json: /lights/0/count: found 1.5; a whole number between 1 and 10000000 belongs here"},
    {"RandomCountTooLarge",
     with_light(
         R"({"type":"random","count":10000001,"seed":1,"box":[[0,3,0],[1,4,1]],"radius":[1,2],"power":[1,2]})"),
     "plates.json: /lights/0/count: found 10000001; a whole number between 1 and 10000000 belongs "
     "here"},
    {"RandomNoRoom",
     with_light(
         light +
         R"(,{"type":"random","count":10000000,"seed":1,"box":[[0,3,0],[1,4,1]],"radius":[1,2],"power":[1,2]})"),
     "plates.json: /lights/1/count: found 10000000 lights, after 1 before; a scene has at most "
     "10000000 lights"},
    {"RandomSeedNegative",
     with_light(
         R"({"type":"random","count":1,"seed":-1,"box":[[0,3,0],[1,4,1]],"radius":[1,2],"power":[1,2]})"),
     "plates.json: /lights/0/seed: found -1; a whole number between 0 and 18446744073709551615 "
     "belongs here"},
    {"RandomBoxReversed",
     with_light(
         R"({"type":"random","count":1,"seed":1,"box":[[0,5,0],[1,4,1]],"radius":[1,2],"power":[1,2]})"),
     "plates.json: /lights/0/box: found a first corner that is above the second"},
    {"RandomBoxTooFar",
     with_light(
         R"({"type":"random","count":1,"seed":1,"box":[[0,3,0],[1,4,1e16]],"radius":[1,2],"power":[1,2]})"),
     "plates.json: /lights/0/box: found a coordinate beyond the limit; a coordinate lies within "
     "±1e+15"},
    {"RandomRadiusZero", with_light(random_start + R"("radius":[0,1],"power":[1,2]})"),
     "plates.json: /lights/0/radius: found [0,1]" + range_allowed},
    {"RandomPowerReversed", with_light(random_start + R"("radius":[1,1],"power":[3,2]})"),
     "plates.json: /lights/0/power: found [3,2]" + range_allowed},
    {"RandomRadianceTooLarge", with_light(random_start + R"("radius":[1e-30,1],"power":[1,1e10]})"),
     "plates.json: /lights/0/power: found 1e+10, for a radius of 1e-30; radiance times radius is "
     "0, or lies between"},
};
INSTANTIATE_TEST_SUITE_P(SceneJson, EveryBadScene, testing::ValuesIn(bad_scenes),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SceneJson, NamesTheMeshAndTheReasonAtItsPlaceInTheScene)
{
    const TemporaryFolder folder;
    folder.write("flat.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n");
    folder.write("box.fbx", "x");
    const auto mesh = [&](const std::string& file) {
        return message_about_scene(lit(grey_lambert + R"(,"surfaces":[{"type":"mesh","file":")" +
                                       file + R"(","material":"floor"}])"),
                                   folder / "s.json");
    };
    const std::string place = (folder / "s.json").string() + ": /surfaces/0/file: found ";
    EXPECT_EQ(mesh("flat.obj")
                  .rfind(place + "\"flat.obj\", a mesh without triangles that have an area; a mesh "
                                 "has at least one triangle",
                         0),
              0u);
    EXPECT_EQ(
        mesh("box.fbx").rfind(
            place + "\"box.fbx\", a file name that ends in \".fbx\"; a mesh is an OBJ or PLY file",
            0),
        0u);
}

TEST(SceneJson, NamesTheTableItsLineAndColumn)
{
    const TemporaryFolder folder;
    folder.write("bulbs.csv", "x,y,z,radius,r,g,b\n1,2,3,-4,5,6,7\n");
    const std::string message = message_about_scene(
        with_light(R"({"type":"table","file":"bulbs.csv"})"), folder / "s.json");
    EXPECT_EQ(message.rfind((folder / "bulbs.csv").string() +
                                ": line 2, column radius: found -4; a radius is greater than 0",
                            0),
              0u)
        << message;
}

TEST(SceneJson, RefusesFilesThatAreNoScene)
{
    const TemporaryFolder folder;
    const auto message = [](const std::filesystem::path& file) -> std::string {
        try {
            read_scene(file);
        } catch (const SceneError& error) {
            return std::string(error.what()).substr(file.string().size());
        }
        return "accepted";
    };
    EXPECT_EQ(message(folder / "none.json"),
              ": found no such file; a scene is a file that exists\n    Check the path.");
    EXPECT_EQ(message(folder / ""),
              ": found a directory; a scene is a file\n    Name a file in it.");
    EXPECT_EQ(message(folder.write("empty.json", "")),
              ": found an empty file; a scene has content\n    Check that it was written in full.");
    const std::filesystem::path large = folder.write("large.json", "{}");
    std::filesystem::resize_file(
        large, limits::scene_file_bytes + 1);  // a hole: takes no room on the disk
    EXPECT_EQ(message(large),
              ": found more than 1073741824 bytes; a scene has at most 1073741824 bytes\n    Split "
              "the scene.");
}

TEST(SceneJson, StaysShortWhateverIsWrong)
{
    const std::string long_text(1'000'000, 'a');
    for (const std::string& text :
         {"{\"" + long_text, "{\"a\": " + long_text, lit("\"name\":[\"" + long_text + "\"]")})
        EXPECT_LT(message_about_scene(text).size(), 500u);
}

// ── the schema for editors ──

const Json& schema()
{
    static const Json read = [] {
        std::ifstream stream(source_dir() / "docs/scene.schema.json");
        return Json::parse(stream)["$defs"];
    }();
    return read;
}

template <class Names> std::set<std::string> set_of(const Names& names)
{
    return {names.begin(), names.end()};
}

std::set<std::string> schema_keys(const std::string& object)
{
    std::set<std::string> keys;
    for (const auto& [key, rule] : schema().at(object).at("properties").items()) keys.insert(key);
    return keys;
}

std::set<std::string> schema_types(const std::string& object)
{
    return set_of(
        schema().at(object).at("properties").at("type").at("enum").get<std::vector<std::string>>());
}

TEST(SceneSchema, HasTheKeysAndTypesThatTheReaderAccepts)
{
    EXPECT_EQ(schema_keys("scene"), set_of(scene_keys::scene));
    EXPECT_EQ(schema_keys("camera"), set_of(scene_keys::camera));
    EXPECT_EQ(schema_keys("probe"), set_of(scene_keys::probe));
    EXPECT_EQ(schema_keys("mesh"), set_of(scene_keys::mesh));
    EXPECT_EQ(schema_keys("transform"), set_of(scene_keys::transform));
    EXPECT_EQ(schema_keys("sphere"), set_of(scene_keys::sphere));
    EXPECT_EQ(schema_keys("quad"), set_of(scene_keys::quad));
    EXPECT_EQ(schema_keys("light"), set_of(scene_keys::light));
    EXPECT_EQ(schema_keys("table"), set_of(scene_keys::table));
    EXPECT_EQ(schema_keys("random"), set_of(scene_keys::random));
    EXPECT_EQ(schema_types("surface"), set_of(scene_keys::surface_types));
    EXPECT_EQ(schema_types("any_light"), set_of(scene_keys::light_types));
    EXPECT_EQ(schema_types("material"), set_of(material_type_names));
    for (const MaterialType& type : material_types) {
        const std::string name(type.name);
        EXPECT_EQ(schema_keys(name), set_of(scene_keys::material(type)));
        std::set<std::string> required;
        for (const MaterialField& field : type.fields)
            if (field.required) required.insert(std::string(field.name));
        EXPECT_EQ(set_of(schema().at(name).at("required").get<std::vector<std::string>>()),
                  required);
    }
}

TEST(SceneSchema, StatesTheLimitsOfTheRules)
{
    EXPECT_EQ(schema()["radius"]["minimum"], limits::min_radius);
    EXPECT_EQ(schema()["radius"]["maximum"], limits::length);
    EXPECT_EQ(schema()["point"]["items"]["maximum"], limits::length);
    EXPECT_EQ(schema()["random"]["properties"]["count"]["maximum"], limits::lights);
    EXPECT_EQ(schema()["camera"]["properties"]["resolution"]["items"]["maximum"],
              limits::resolution);
    EXPECT_EQ(schema()["exponent"]["maximum"], limits::material_number);
    EXPECT_EQ(schema()["ggx"]["properties"]["alpha"]["minimum"], limits::min_alpha);
}

TEST(SceneFormatPage, NamesEveryKeyAndEveryLimit)
{
    std::ifstream stream(source_dir() / "docs/scene-format.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    const auto expect_named = [&](const auto& keys) {
        for (const std::string_view key : keys)
            EXPECT_NE(page.find("`" + std::string(key) + "`"), page.npos) << key;
    };
    expect_named(scene_keys::scene), expect_named(scene_keys::camera),
        expect_named(scene_keys::probe);
    expect_named(scene_keys::mesh), expect_named(scene_keys::transform),
        expect_named(scene_keys::sphere), expect_named(scene_keys::quad);
    expect_named(scene_keys::light), expect_named(scene_keys::random),
        expect_named(scene_keys::columns);
    expect_named(scene_keys::surface_types), expect_named(scene_keys::light_types);
    for (const MaterialType& type : material_types)
        expect_named(scene_keys::material(type)), expect_named(std::array{type.name});
    for (const char* limit : {"10 000 000", "50 000 000", "16384", "1 GiB", "64 levels", "1e15",
                              "1e-30", "1e37", "1e-37", "1e9", "1e-9", "1e-18", "1e-15", "1e-36"})
        EXPECT_NE(page.find(limit), page.npos) << limit;
}

}  // namespace
}  // namespace mis
