// Who may include whom: the house's plan as a table, and a look at every #include line of the tree.
#include "tests/support/places.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Names = std::set<std::string>;
using Sources = std::map<std::string, std::string>;  ///< path from the root → text
using Graph = std::map<std::string, Names>;          ///< room → rooms

/// A room includes the rooms and files named here, and what those rooms may include.
const Graph may_include{
    {"math", {}},
    {"sampling", {"math"}},
    {"scene", {"sampling"}},
    {"bsdf", {"scene"}},
    {"policy", {"bsdf"}},
    {"heuristic", {"math"}},
    {"trace", {"scene"}},
    {"technique", {"policy", "bsdf", "trace"}},
    {"strategy", {"policy", "technique", "heuristic"}},
    {"effects", {"trace", "strategy"}},
    {"learn", {"math"}},
    {"engine",
     {"technique", "heuristic", "strategy", "effects", "learn", "run/executor.h", "run/pool.h",
      "run/made_once.h", "run/serial.h"}},
    {"predict", {"technique", "heuristic", "strategy", "run/executor.h"}},
    {"report", {"strategy", "effects"}},
    {"stats", {"report"}},
    {"study", {"stats", "engine", "predict", "run/executor.h"}},
    {"cost", {"study"}},
    {"changes", {"stats"}},
    {"words", {"report", "stats", "effects"}},
    {"run", {"math"}},
    {"io", {"report", "words", "engine", "predict"}},
    {"bind", {"engine"}},
    {"bind/python", {"study", "cost", "io", "run"}},
    {"mis.h", {"engine", "run/serial.h"}},  // the core in one include
    {"c.h", {"bind/c.h"}},                  // the same for C
    {"cli", {"study", "cost", "changes", "io", "bind", "run", "mis.h"}},
};

/// What stands between the angle brackets begins so: only these rooms or files may include it.
const std::map<std::string, Names> outside_headers{
    {"embree", {"trace/embree.h", "trace/embree.cpp"}},
    {"tbb/", {"run/tbb.h", "run/tbb.cpp"}},
    {"oneapi/", {"run/tbb.h", "run/tbb.cpp"}},
    {"OpenImageIO/", {"io"}},
    {"nlohmann/", {"io"}},
    {"fmt/", {"io", "cli", "bind/python"}},
    {"CLI/", {"cli"}},
    {"pybind11/", {"bind/python"}},
    {"boost/", {"predict", "stats"}},
    // Threads, files and people are known at the rim alone.
    {"thread", {"run", "cli"}},
    {"mutex", {"run", "io", "cli"}},
    {"future", {"run", "cli"}},
    {"condition_variable", {"run", "cli"}},
    {"fstream", {"io", "cli"}},
    {"filesystem", {"io", "cli", "bind/python"}},
    {"iostream", {"cli"}},
};

/// "trace" of "trace/embree.h"; a file at the top is its own room. The Python module is a room
/// within bind: it knows files and threads, which C does not.
std::string room_of(const std::string& path)
{
    return path.starts_with("bind/python") ? "bind/python" : path.substr(0, path.find('/'));
}

/// The names listed for a room, and all that those may include.
Names closure(const std::string& room)
{
    Names all;
    std::vector<std::string> open{room};
    while (!open.empty()) {
        const auto row = may_include.find(open.back());
        open.pop_back();
        if (row == may_include.end()) continue;  // a file
        for (const std::string& name : row->second)
            if (all.insert(name).second) open.push_back(name);
    }
    return all;
}

/// What a text includes, by quotes or angle brackets.
Names includes_of(const std::string& text)
{
    Names names;
    std::istringstream lines(text);
    for (std::string line, hash, name; std::getline(lines, line);) {
        std::istringstream words(line);
        if (!(words >> hash) || hash[0] != '#') continue;
        if (hash == "#") words >> name, hash += name;
        const std::size_t begin = line.find_first_of("<\"");
        const std::size_t end = line.find_first_of(">\"", begin + 1);
        if (hash.starts_with("#include") && begin != line.npos && end != line.npos)
            names.insert(line.substr(begin + 1, end - begin - 1));
    }
    return names;
}

/// A room on a cycle of `graph`, or "".
std::string room_on_a_cycle(const Graph& graph)
{
    for (const auto& [start, _] : graph) {
        Names seen;
        std::vector<std::string> open{start};
        while (!open.empty()) {
            const auto row = graph.find(open.back());
            open.pop_back();
            if (row == graph.end()) continue;
            for (const std::string& next : row->second) {
                if (next == start) return start;
                if (seen.insert(next).second) open.push_back(next);
            }
        }
    }
    return "";
}

/// Is the header `name` of the library `prefix` ("fmt/"), or the standard header of that name?
bool belongs_to(const std::string& name, const std::string& prefix)
{
    return prefix.ends_with('/') || prefix == "embree" ? name.starts_with(prefix) : name == prefix;
}

/// One sentence per broken rule. Paths are below mis/.
std::vector<std::string> violations(const Sources& sources)
{
    std::vector<std::string> found;
    Graph real;
    for (const auto& [path, text] : sources) {
        const std::string room = room_of(path);
        if (!may_include.contains(room)) {
            found.push_back(path + ": the room " + room + " is not in the plan");
            continue;
        }
        const Names allowed = closure(room);
        for (std::string name : includes_of(text)) {
            if (!name.starts_with("mis/")) {
                for (const auto& [prefix, users] : outside_headers)
                    if (belongs_to(name, prefix) && !users.contains(room) && !users.contains(path))
                        found.push_back(path + " includes <" + name + ">, which is for others");
                continue;
            }
            name.erase(0, 4);
            const std::string other = room_of(name);
            if (other == room) continue;
            if (!allowed.contains(other) && !allowed.contains(name))
                found.push_back(path + " includes mis/" + name + ", which " + room + " may not");
            if (room == "strategy" && may_include.at(room).contains(other) &&
                !name.ends_with("/registry.h"))
                found.push_back(path + " includes mis/" + name +
                                ", but strategy knows registries alone");
            if (!name.starts_with("run/")) real[room].insert(other);
        }
    }
    if (const std::string room = room_on_a_cycle(real); !room.empty())
        found.push_back(room + " includes itself in a circle");
    return found;
}

Sources sources_of_the_tree()
{
    namespace fs = std::filesystem;
    const fs::path house = mis::source_dir() / "mis";
    Sources sources;
    for (const auto& entry : fs::recursive_directory_iterator(house)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cpp") continue;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        sources[fs::relative(entry.path(), house).generic_string()] = text.str();
    }
    return sources;
}

TEST(Structure, EveryRoomIncludesOnlyWhatThePlanAllows)
{
    const Sources sources = sources_of_the_tree();
    ASSERT_GT(sources.size(), 20u);
    for (const std::string& sentence : violations(sources)) ADD_FAILURE() << sentence;
}

TEST(Structure, ThePlanHasNoCycle) { EXPECT_EQ(room_on_a_cycle(may_include), ""); }

TEST(Structure, AFileStandsForItselfAndNotForItsRoom)
{
    EXPECT_TRUE(violations({{"engine/a.h", "#include \"mis/run/executor.h\"\n"}}).empty());
    EXPECT_EQ(violations({{"engine/a.h", "#include \"mis/run/tbb.h\"\n"}}).size(), 1u);
}

/// The twin of the first test: each of these texts breaks one rule.
TEST(Structure, SeesEveryBrokenRule)
{
    const std::vector<std::pair<std::string, std::string>> broken{
        {"math/a.h", "#pragma once\n#include \"mis/sampling/cone.h\"\n"},
        {"math/a.h", "  #  include <mis/scene/light.h>"},
        {"heuristic/a.h", "#include \"mis/bsdf/lambert.h\"\n"},
        {"strategy/a.cpp", "#include \"mis/policy/power.h\"\n"},
        {"study/a.cpp", "#include \"mis/words/numbers.h\"\n"},
        {"stats/a.cpp", "#include \"mis/run/executor.h\"\n"},
        {"io/a.cpp", "#include \"mis/study/study.h\"\n"},
        {"trace/analytic.h", "#include <embree3/rtcore.h>\n"},
        {"engine/a.cpp", "#include <tbb/parallel_for.h>\n"},
        {"study/a.cpp", "#include <fmt/format.h>\n"},
        {"io/a.cpp", "#include <CLI/CLI.hpp>\n"},
        {"cli/a.cpp", "#include <nlohmann/json.hpp>\n"},
        {"engine/a.cpp", "#include <thread>\n"},
        {"bind/c.cpp", "#include \"mis/io/scene_json.h\"\n"},
        {"bind/c.cpp", "#include <pybind11/pybind11.h>\n"},
        {"attic/a.h", ""},
    };
    for (const auto& [path, text] : broken)
        EXPECT_EQ(violations({{path, text}}).size(), 1u) << path << "\n" << text;
}

/// Where a type's registered name is compared: visit_named() of the list of types is to do it.
std::vector<std::string> lookups_by_name(const Sources& sources)
{
    std::vector<std::string> found;
    for (const auto& [path, text] : sources)
        for (const char* compared : {"::name ==", "::name !="})
            if (path != "math/type_list.h" && text.find(compared) != text.npos)
                found.push_back(path + " looks a type up by its name; visit_named() does");
    return found;
}

TEST(Structure, TypesAreLookedUpByNameInOnePlace)
{
    for (const std::string& sentence : lookups_by_name(sources_of_the_tree()))
        ADD_FAILURE() << sentence;
    EXPECT_EQ(lookups_by_name({{"engine/a.cpp", "if (P::name == name) f();"}}).size(), 1u);
}

TEST(Structure, SeesACycle)
{
    EXPECT_EQ(room_on_a_cycle({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}), "b");
    EXPECT_EQ(room_on_a_cycle({{"a", {"b", "c"}}, {"b", {"c"}}}), "");
}

}  // namespace
