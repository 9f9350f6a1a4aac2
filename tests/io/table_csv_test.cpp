#include "mis/io/table_csv.h"

#include "mis/io/scene_error.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

Lights lights_of(std::string_view text)
{
    Lights lights;
    append_light_table(text, "bulbs.csv", lights);
    return lights;
}

TEST(TableCsv, ReadsColumnsInTheOrderOfTheHeader)
{
    const Lights lights = lights_of("b,g,r,radius,z,y,x\n3,2,1,0.5,30,20,10\n");
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].center, (Vec3<double>{10, 20, 30}));
    EXPECT_EQ(lights[0].radius, 0.5);
    EXPECT_EQ(lights[0].radiance_radius, (Vec3<float>{0.5f, 1, 1.5f}));
}

TEST(TableCsv, KeepsPositionsInDouble)
{
    EXPECT_EQ(lights_of("x,y,z,radius,r,g,b\n1000000.0000001,0,0,1,1,1,1").at(0).center.x,
              1000000.0000001);
}

TEST(TableCsv, ReadsWhatSpreadsheetsWrite)
{
    const std::string plain = "x,y,z,radius,r,g,b\n1,2,3,4,5,6,7\n2,2,3,4,5,6,7\n";
    const std::string dressed =
        "\xEF\xBB\xBFx, y,z ,radius,r,g,b\r\n1, 2,\t3,4,5,6,7\r\n2,2,3,4,5,6,7\r\n\r\n\n";
    const Lights a = lights_of(plain), b = lights_of(dressed);
    ASSERT_EQ(a.size(), 2u);
    ASSERT_EQ(b.size(), 2u);
    EXPECT_EQ(a[1].center, b[1].center);
    EXPECT_EQ(a[1].radiance_radius, b[1].radiance_radius);
}

TEST(TableCsv, AppendsToTheLightsThatAreThere)
{
    Lights lights = lights_of("x,y,z,radius,r,g,b\n1,2,3,4,5,6,7\n");
    append_light_table("x,y,z,radius,r,g,b\n8,2,3,4,5,6,7\n", "bulbs.csv", lights);
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[1].center.x, 8);
}

struct BadTable {
    const char* name;
    std::string text, message;  ///< the message's first words
};

void PrintTo(const BadTable& table, std::ostream* out) { *out << table.name; }

class EveryBadTable : public testing::TestWithParam<BadTable> {};

TEST_P(EveryBadTable, GivesOneMessageWithLineAndColumn)
{
    Lights lights;
    try {
        append_light_table(GetParam().text, "bulbs.csv", lights);
        FAIL() << "was accepted";
    } catch (const SceneError& error) {
        EXPECT_EQ(std::string(error.what()).substr(0, GetParam().message.size()),
                  GetParam().message);
        EXPECT_NE(std::string(error.what()).find("\n    "), std::string::npos) << "what to do";
    }
}

const std::string header = "x,y,z,radius,r,g,b\n";
const std::string columns = "the columns are x, y, z, radius, r, g, b, in any order";
const std::string no_row_names =
    "\n    Remove the column: row names, in R by row.names = FALSE, in pandas by index=False.";
const BadTable bad_tables[] = {
    {"BadNumber", header + "1,2,3,4,5,6,7\n1,2,3,abc,5,6,7\n",
     "bulbs.csv: line 3, column radius: found \"abc\"; a finite number belongs here\n    Write it "
     "as 0.5 or 1e-3."},
    {"NumberWithTail", header + "1,2,3,4,5,6,7x\n",
     "bulbs.csv: line 2, column b: found \"7x\"; a finite number belongs here\n    Write it as 0.5 "
     "or 1e-3."},
    {"EmptyField", header + "1,,3,4,5,6,7\n",
     "bulbs.csv: line 2, column y: found \"\"; a finite number belongs here\n    Write it as 0.5 "
     "or 1e-3."},
    {"Nan", header + "nan,2,3,4,5,6,7\n",
     "bulbs.csv: line 2, column x: found \"nan\"; a finite number belongs here\n    Write it as "
     "0.5 or 1e-3."},
    {"Infinite", header + "1,2,3,4,inf,6,7\n",
     "bulbs.csv: line 2, column r: found \"inf\"; a finite number belongs here\n    Write it as "
     "0.5 or 1e-3."},
    {"OutOfRange", header + "1,2,3,4,5,1e999,7\n",
     "bulbs.csv: line 2, column g: found \"1e999\"; a number lies within the range of a double\n   "
     " Use other units."},
    {"Underflow", header + "1,2,3,4,5,1e-999,7\n",
     "bulbs.csv: line 2, column g: found \"1e-999\"; a number lies within the range of a double\n  "
     "  Use other units."},
    {"NegativeRadius", header + "1,2,3,-4,5,6,7\n",
     "bulbs.csv: line 2, column radius: found -4; a radius is greater than 0\n    Make it "
     "positive, or remove the sphere."},
    {"NegativeRadiance", header + "1,2,3,4,5,-6,7\n",
     "bulbs.csv: line 2, columns r, g, b: found [5, -6, 7]; a radiance is finite and not "
     "negative\n    Make it positive, or 0 for a black light."},
    {"FarAway", header + "1,2e15,3,4,5,6,7\n",
     "bulbs.csv: line 2, columns x, y, z: found [1, 2e+15, 3]; a coordinate lies within ±1e+15 "
     "scene units\n    Use larger units, or move the scene closer to its origin."},
    {"ShortRow", header + "1,2,3\n",
     "bulbs.csv: line 2: found 3 fields; a row has 7 fields, as the header has\n    Mend or remove "
     "the line."},
    {"LongRow", header + "1,2,3,4,5,6,7,8\n",
     "bulbs.csv: line 2: found 8 fields; a row has 7 fields, as the header has\n    Mend or remove "
     "the line; a number is written 0.5, not 0,5, and rows have no names."},
    {"NoBreakSpace", header + "1,2,\u00A03,4,5,6,7\n",
     "bulbs.csv: line 2, column z: found \"\u00A03\", which has in it U+00A0, a no-break space; a "
     "finite number belongs here"},
    {"NoBreakSpaceInTheHeader", "x,y,\u00A0z,radius,r,g,b\n1,2,3,4,5,6,7\n",
     "bulbs.csv: line 1: found the unknown column \"\u00A0z\", which has in it U+00A0, a no-break "
     "space; "},
    {"EmptyLineWithin", header + "1,2,3,4,5,6,7\n\n1,2,3,4,5,6,7\n",
     "bulbs.csv: line 3: found an empty line; a row has 7 fields, as the header has\n    Mend or "
     "remove the line."},
    {"MissingColumn", "x,y,z,r,g,b\n1,2,3,4,5,6\n",
     "bulbs.csv: line 1: found no column \"radius\"; " + columns + "\n    Add it."},
    {"UnknownColumn", "x,y,z,raduis,r,g,b\n",
     "bulbs.csv: line 1: found the unknown column \"raduis\"; " + columns +
         "\n    Did you mean \"radius\"?"},
    {"ExtraColumn", "x,y,z,radius,r,g,b,weight\n",
     "bulbs.csv: line 1: found the unknown column \"weight\"; " + columns + "\n    Remove it."},
    {"ColumnTwice", "x,y,z,radius,r,g,r\n",
     "bulbs.csv: line 1: found the column \"r\" a second time; " + columns +
         "\n    Remove one of the two."},
    {"TrailingComma", "x,y,z,radius,r,g,b,\n",
     "bulbs.csv: line 1: found no name for column 8; " + columns + no_row_names},
    {"RowNames", ",x,y,z,radius,r,g,b\n1,1,2,3,4,5,6,7\n",
     "bulbs.csv: line 1: found no name for column 1; " + columns + no_row_names},
    {"QuotedHeader",
     R"("x","y","z","radius","r","g","b")"
     "\n1,2,3,4,5,6,7\n",
     R"(bulbs.csv: line 1: found a header in quotes: "\"x\",\"y\",\"z\",\"radius\",\"r\",\"g\",\"b\""; )" +
         columns +
         ", without quotes\n    Remove the quotes; in R: write.csv(..., quote = FALSE, row.names = "
         "FALSE)."},
    {"HeaderOfR",
     R"("","x","y","z","radius","r","g","b")"
     "\n\"1\",1,2,3,4,5,6,7\n",
     R"(bulbs.csv: line 1: found a header in quotes: )"},
    {"SingleQuotes", "'x','y','z','radius','r','g','b'\n",
     "bulbs.csv: line 1: found a header in quotes: "},
    {"OneColumnQuoted", "x,y,z,\"radius\",r,g,b\n",
     "bulbs.csv: line 1: found a header in quotes: "},
    {"QuotedNumber", header + "1,2,\"3\",4,5,6,7\n",
     R"(bulbs.csv: line 2, column z: found "\"3\""; a finite number belongs here)"
     "\n    Write it without quotes."},
    {"TwoSigns", header + "1,2,+-3,4,5,6,7\n",
     "bulbs.csv: line 2, column z: found \"+-3\"; a finite number belongs here"},
    {"Hexadecimal", header + "1,2,0x1p3,4,5,6,7\n",
     "bulbs.csv: line 2, column z: found \"0x1p3\"; a finite number belongs here\n    Write it as "
     "0.5 or 1e-3."},
    {"Semicolons", "x;y;z;radius;r;g;b\n1;2;3;4;5;6;7\n",
     "bulbs.csv: line 1: found the header \"x;y;z;radius;r;g;b\", separated by semicolons; " +
         columns + "\n    Separate the columns by commas, and write 0.5, not 0,5."},
    {"Tabs", "x\ty\tz\tradius\tr\tg\tb\n1\t2\n",
     "bulbs.csv: line 1: found the header \"x\\ty\\tz\\tradius\\tr\\tg\\tb\", separated by tabs; " +
         columns},
    {"SemicolonsInRows", header + "0,5;1;2;3;4;5;6\n",
     "bulbs.csv: line 2: found 2 fields and semicolons; a row has 7 fields, as the header has\n    "
     "Separate the fields by commas, and write 0.5, not 0,5."},
    {"NoHeader", "1,2,3,4,5,6,7\n",
     "bulbs.csv: line 1: found numbers where the header belongs; " + columns +
         "\n    Begin with the line x,y,z,radius,r,g,b."},
    {"LinesOfOldMacs", "x,y,z,radius,r,g,b\r1,2,3,4,5,6,7\r",
     "bulbs.csv: line 1: found a carriage return (CR) that ends the line; a line ends in LF or CR "
     "LF\n    Save the table with the line ends of Unix or Windows."},
    {"MixedLineEnds", header + "1,2,3,4,5,6,7\r\n1,2,3,4,5,6,7\r1,2,3,4,5,6,7\n",
     "bulbs.csv: line 3: found a carriage return (CR) that ends the line; "},
    {"Utf16", std::string("\xFF\xFEx\0,\0y\0", 8),
     "bulbs.csv: found UTF-16 text (little-endian); the text is UTF-8, without zero bytes\n    "
     "Save it as UTF-8."},
    {"Utf16BigEndian", std::string("\xFE\xFF\0x\0,\0y", 8),
     "bulbs.csv: found UTF-16 text (big-endian); "},
    {"Utf16WithoutAMark", std::string("x\0,\0y\0,\0z\0", 10),
     "bulbs.csv: found UTF-16 text (little-endian); "},
    {"Utf32", std::string("\xFF\xFE\0\0x\0\0\0", 8),
     "bulbs.csv: found UTF-32 text (little-endian); "},
    {"Packed", std::string("PK\x03\x04rest", 8),
     "bulbs.csv: found a zip file, as spreadsheets are; the text is UTF-8, without zero bytes\n    "
     "Unpack it, or save it as text."},
    {"Latin1", header + "1,2,3,4,5,6,7\n1,2,3,4,\xE9,6,7\n",
     "bulbs.csv: line 3, column 9: found byte 0xE9; the text is UTF-8, without zero bytes"},
    {"ZeroByte", header + std::string("1,2,3,4,5,6,7\0", 14),
     "bulbs.csv: line 2, column 14: found byte 0x00; "},
    {"NoRows", header,
     "bulbs.csv: line 1: found a header and no rows; a table has at least one light\n    Add a "
     "row."},
    {"Blank", "\n\n",
     "bulbs.csv: line 1: found the header \"\"; " + columns +
         "\n    Separate the columns by commas, and write 0.5, not 0,5."},
};
INSTANTIATE_TEST_SUITE_P(TableCsv, EveryBadTable, testing::ValuesIn(bad_tables),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(TableCsv, RefusesAnEmptyFileAndAMissingOne)
{
    const TemporaryFolder folder;
    Lights lights;
    EXPECT_THROW(append_light_table(folder.write("empty.csv", ""), lights), SceneError);
    EXPECT_THROW(append_light_table(folder / "missing.csv", lights), SceneError);
    append_light_table(folder.write("good.csv", header + "1,2,3,4,5,6,7"), lights);
    EXPECT_EQ(lights.size(), 1u);
}

TEST(TableCsv, RefusesTheLightBeyondTheLimit)
{
    Lights lights(limits::lights - 1, make_light({0, 0, 0}, 1, Vec3<double>(1)));
    append_light_table(header + "1,2,3,4,5,6,7\n", "bulbs.csv", lights);
    EXPECT_EQ(lights.size(), limits::lights);
    EXPECT_THROW(append_light_table(header + "1,2,3,4,5,6,7\n", "bulbs.csv", lights), SceneError);
}

}  // namespace
}  // namespace mis
