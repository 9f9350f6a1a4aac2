#include "tests/cli/program.h"

#include "mis/io/text_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace mis {
namespace {

/// What a terminal of that size shows of the program, once what shows how far it is was wiped.
std::string on_terminal(int columns, int rows, const std::string& words,
                        const std::string& environment = "TERM=xterm")
{
    const TemporaryFolder folder;
    const std::string out = (folder / "out").string(),
                      script =
                          folder
                              .write("run.sh", "stty cols " + std::to_string(columns) + " rows " +
                                                   std::to_string(rows) + "\n'" +
                                                   program_file().string() + "' " + words + "\n")
                              .string();
    const std::string command = "env -u COLUMNS -u LINES -u NO_COLOR " + environment +
                                " script -qec 'sh " + script + "' /dev/null >'" + out +
                                "' </dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << words;
    std::string shown = text_of(out);
    std::erase(shown, '\r');
    const std::size_t wiped = shown.rfind("\x1b[J");
    return wiped == shown.npos ? shown : shown.substr(wiped + 3);
}

/// Without bold and colour.
std::string bare(const std::string& styled)
{
    std::string text;
    for (std::size_t i = 0; i < styled.size(); ++i) {
        if (styled[i] == '\x1b') i = std::min(styled.find('m', i), styled.size());
        else text += styled[i];
    }
    return text;
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string compare_words()
{
    return "compare '" + scene("veach") + "' --resolution 32x24 --spp 1024 ";
}

TEST(Terminal, ShowsTheAnswerOnItsLastLines)
{
    struct Run {
        std::string words;
        const char* answer;  ///< how it begins
    };
    for (const Run& run :
         {Run{compare_words(), "Use "},
          {"cost '" + scene("veach") + "' --resolution 32x24 --spp 16 ", "In time the error of "},
          {"predict '" + scene("eclipse") + "'", "Over 3 probes "}}) {
        const std::vector<std::string> lines = lines_of(bare(on_terminal(80, 24, run.words)));
        const std::size_t first = lines.size() - std::min<std::size_t>(lines.size(), 23);
        const bool is_there =
            std::any_of(lines.begin() + static_cast<std::ptrdiff_t>(first), lines.end(),
                        [&](const std::string& line) { return line.starts_with(run.answer); });
        EXPECT_TRUE(is_there) << run.words;
        EXPECT_TRUE(lines.back().ends_with('.')) << lines.back();
    }
}

TEST(Terminal, IsFilledToItsWidthAndNotBeyond)
{
    for (const int columns : {60, 80, 120})
        for (const std::string& words : {compare_words() + "--verbose", std::string("help compare"),
                                         "explain '" + scene("veach") + "'"})
            for (const std::string& line : lines_of(bare(on_terminal(columns, 24, words))))
                EXPECT_LE(width_of(line), static_cast<std::size_t>(columns)) << line;
    const std::string wide = on_terminal(120, 24, compare_words()),
                      told = on_terminal(80, 24, compare_words(), "TERM=xterm COLUMNS=120");
    EXPECT_NE(wide.find("efficiency"), std::string::npos) << wide;
    EXPECT_NE(told.find("efficiency"), std::string::npos) << "COLUMNS goes before";
    EXPECT_EQ(mis_with(compare_words()).out.find("efficiency time"), std::string::npos)
        << "what is no terminal has 80 columns";
}

TEST(Terminal, AloneHasBoldAndColour)
{
    EXPECT_NE(on_terminal(80, 24, compare_words()).find("\x1b[1m"), std::string::npos);
    for (const char* plain : {"TERM=xterm NO_COLOR=1", "TERM=dumb", "TERM="}) {
        const std::string shown = on_terminal(80, 24, compare_words(), plain);
        EXPECT_EQ(shown.find("\x1b[1"), std::string::npos) << plain;
        EXPECT_NE(shown.find("rank  strategy"), std::string::npos) << plain;
    }
    EXPECT_EQ(on_terminal(80, 24, compare_words(), "TERM=dumb").find('\x1b'), std::string::npos)
        << "it cannot move its cursor";
    EXPECT_EQ(mis_with(compare_words()).out.find('\x1b'), std::string::npos);
    EXPECT_EQ(on_terminal(80, 24, compare_words() + "--json - --quiet").find('\x1b'),
              std::string::npos);
}

/// Where standard error is a terminal; a pipe gets each message on one line.
TEST(Terminal, BreaksMessagesBetweenWords)
{
    const std::string words = "explain s.json --output x";
    const std::string piped = mis_with(words).error;
    EXPECT_EQ(lines_of(piped).size(), 1U) << piped;
    const std::string shown = on_terminal(40, 24, words + " || true");
    for (const std::string& line : lines_of(shown)) EXPECT_LE(width_of(line), 40U) << line;
    std::string joined;
    for (const std::string& line : lines_of(shown))
        joined += (joined.empty() ? "" : " ") + line.substr(line.find_first_not_of(' '));
    EXPECT_EQ(joined + "\n", piped);
}

}  // namespace
}  // namespace mis
