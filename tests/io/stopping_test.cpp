// Every reader ends once it is told to, without having read on to the end.
#include "mis/io/random_lights.h"
#include "mis/io/report_read.h"
#include "mis/io/scene_json.h"
#include "mis/io/table_csv.h"
#include "mis/io/text_file.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// A token that is up from the (k + 1)th time on that it is asked.
class AfterAsks {
public:
    explicit AfterAsks(int k) : left_(k) {}
    StopToken token() const { return StopToken(&asked_); }

private:
    int left_;
    std::function<bool()> asked_ = [this] { return left_-- <= 0; };
};

const std::string probe =
    R"("probes":[{"position":[0,0,0],"normal":[0,1,0],"outgoing":[0,1,0],"material":"m"}],)"
    R"("materials":{"m":{"type":"lambert","albedo":0.5}},)";

std::string scene_of(const std::string& lights)
{
    return R"({"format":"mis-scene/1",)" + probe + R"("lights":[)" + lights + "]}";
}

TEST(Readers, EndWithinAFileOfBytes)
{
    const TemporaryFolder folder;
    const auto file = folder.write("long.txt", std::string(std::size_t{1} << 20, 'x'));
    EXPECT_NO_THROW(read_text_file(file, "scene"));
    EXPECT_THROW(read_text_file(file, "scene", AfterAsks(3).token()), Stopped);
    EXPECT_THROW(require_utf8(std::string(5'000'000, 'x'), file, AfterAsks(3).token()), Stopped);
}

TEST(Readers, EndWithinASceneOfManyLightsOrOfBlanks)
{
    const std::string light = R"({"center":[0,2,0],"radius":1,"radiance":1})";
    std::string lights = light;
    for (int i = 0; i < 20'000; ++i) lights += "," + light;
    const std::string many = scene_of(lights), blank = scene_of(light + std::string(400'000, ' '));
    for (const std::string& text : {many, blank}) {
        EXPECT_NO_THROW(parse_scene(text, "lights.json"));
        EXPECT_THROW(parse_scene(text, "lights.json", AfterAsks(4).token()), Stopped);
    }
}

TEST(Readers, EndWithinATable)
{
    std::string table = "x,y,z,radius,r,g,b\n";
    for (int i = 0; i < 100'000; ++i) table += "1,2,3,4,5,6,7\n";
    Lights lights;
    EXPECT_THROW(append_light_table(table, "bulbs.csv", lights, AfterAsks(4).token()), Stopped);
    EXPECT_GT(lights.size(), 0U);
    EXPECT_LT(lights.size(), 100'000U);
    const std::string commas = "x,y,z,radius,r,g,b\n" + std::string(100'000, ','),
                      blanks = "x,y,z,radius,r,g,b\n" + std::string(100'000, '\n');
    for (const std::string& text : {commas, blanks})
        EXPECT_THROW(append_light_table(text, "bulbs.csv", lights, AfterAsks(2).token()), Stopped);
}

TEST(Readers, EndWithinRandomLights)
{
    const RandomLights wanted{.count = 100'000,
                              .seed = 1,
                              .box = {Vec3<double>(0), Vec3<double>(1)},
                              .radius = {0.1, 1},
                              .power = {1, 2}};
    Lights lights;
    EXPECT_THROW(append_random_lights(wanted, lights, AfterAsks(2).token()), Stopped);
    EXPECT_LT(lights.size(), 100'000U);
}

TEST(Readers, EndWhileTheRulesAreChecked)
{
    Scene scene = parse_scene(scene_of(R"({"center":[0,2,0],"radius":1,"radiance":1})"), "a.json");
    scene.lights.resize(100'000, scene.lights[0]);
    EXPECT_FALSE(find_problem(scene));
    EXPECT_THROW(find_problem(scene, AfterAsks(6).token()), Stopped);
}

TEST(Readers, EndWithinAReport)
{
    EXPECT_THROW(
        parse_report("{}" + std::string(400'000, ' '), "report.json", AfterAsks(2).token()),
        Stopped);
}

}  // namespace
}  // namespace mis
