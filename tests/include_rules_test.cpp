// Who may include whom (docs/architecture.md): linking alone does not catch headers.
#include "base/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace obscura {
namespace {

namespace fs = std::filesystem;
const fs::path root = OBSCURA_SOURCE;

using Rooms = std::set<std::string>;

// The table of docs/architecture.md. A room may use itself and the rooms named here; a room is the
// longest of these names that a file's path begins with.
const std::map<std::string, Rooms> allowed = [] {
    std::map<std::string, Rooms> table;
    const auto room = [&](const std::string& name, Rooms direct) {
        for (const std::string& below : Rooms(direct)) // what a room may use, its users may too
            direct.insert(table.at(below).begin(), table.at(below).end());
        direct.insert(name);
        table[name] = direct;
    };
    room("base", {});
    room("gl", {"base"});
    room("image", {"base"});
    room("report", {"base"});
    room("protocols", {"base"});
    room("entry", {"protocols"});
    room("metrics", {"image", "protocols"});
    room("renderer/scene", {"image", "protocols"});
    room("renderer/builtin", {"renderer/scene"});
    room("renderer/shaders", {});
    room("renderer/frame", {"renderer/scene", "renderer/shaders", "gl"});
    room("renderer/techniques", {"renderer/frame"});
    room("renderer/reference", {"renderer/frame"});
    room("renderer", {"renderer/builtin", "renderer/techniques", "renderer/reference", "metrics"});
    room("matching", {"renderer"});
    room("stimuli", {"matching"});
    room("viewer", {"matching"});
    room("bench", {"matching", "report"});
    room("inference", {"base"});
    room("bench/analysis", {"inference"});
    room("experiment", {"gl", "image", "inference", "protocols"});
    room("analysis", {"inference", "report", "protocols"});
    room("archive", {"stimuli", "analysis"});
    room("validity", {"experiment", "analysis"});
    return table;
}();

// What the table forbids and the house allows: the file, what it includes, and why.
const std::map<std::pair<std::string, std::string>, std::string> exceptions = {
    {{"renderer/reference/traced.h", "renderer/techniques/settings.h"},
     "the row ray_traced of the technique table is the reference"},
};

// Tests lie in a mirror of the rooms and may use what the room that they test may use; those of the
// renderer's rooms the whole renderer, for a technique is judged by the reference and seen in a
// rendering.
std::string roomOf(std::string path) {
    if (path.starts_with("tests/renderer/"))
        return "renderer";
    if (path.starts_with("tests/"))
        path.erase(0, std::string("tests/").size());
    std::string longest;
    for (const auto& [room, rooms] : allowed)
        if (path.starts_with(room + "/") && room.size() > longest.size())
            longest = room;
    return longest; // "" for what serves all tests
}

struct File {
    std::string path;
    std::string text;
    std::vector<std::string> ours;   // what it includes of the project
    std::vector<std::string> theirs; // and of libraries
};

const std::vector<File>& files() {
    static const std::vector<File> all = [] {
        const std::regex include(R"(^#include ["<]([^">]+)[">])");
        Rooms tops{"tests"};
        for (const auto& [room, rooms] : allowed)
            tops.insert(room.substr(0, room.find('/')));
        std::vector<File> found;
        for (const std::string& top : tops)
            for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
                const std::string extension = entry.path().extension().string();
                if (extension != ".h" && extension != ".cpp")
                    continue;
                File file{fs::relative(entry.path(), root).generic_string(),
                          readFile(entry.path()),
                          {},
                          {}};
                std::istringstream lines(file.text);
                std::smatch match;
                for (std::string line; std::getline(lines, line);)
                    if (std::regex_search(line, match, include))
                        (fs::exists(root / match[1].str()) &&
                                 match[1].str().find('/') != std::string::npos
                             ? file.ours
                             : file.theirs)
                            .push_back(match[1]);
                found.push_back(std::move(file));
            }
        return found;
    }();
    return all;
}

TEST(IncludeRules, RoomsUseOnlyWhatTheyMay) {
    std::size_t seen = 0;
    for (const File& file : files())
        for (const std::string& included : file.ours) {
            ++seen;
            const std::string room = roomOf(file.path);
            if (included.starts_with("tests/")) {
                EXPECT_TRUE(file.path.starts_with("tests/"))
                    << file.path << " includes " << included;
                continue;
            }
            if (room.empty() || exceptions.contains({file.path, included}))
                continue;
            EXPECT_TRUE(allowed.at(room).contains(roomOf(included)))
                << file.path << " includes " << included << ", which " << room << " may not use";
        }
    EXPECT_GT(seen, 500U);
}

TEST(IncludeRules, EveryFileIsInARoom) {
    for (const File& file : files())
        EXPECT_TRUE(file.path.starts_with("tests/") || !roomOf(file.path).empty()) << file.path;
}

TEST(IncludeRules, ExceptionsAreNeeded) {
    for (const auto& [exception, reason] : exceptions) {
        const std::string &path = exception.first, &included = exception.second;
        const auto file = std::find_if(files().begin(), files().end(),
                                       [&](const File& each) { return each.path == path; });
        ASSERT_NE(file, files().end()) << path;
        EXPECT_NE(std::find(file->ours.begin(), file->ours.end(), included), file->ours.end())
            << path << " no longer includes " << included;
    }
}

// A header and its source are one unit: neither may lead back to it.
std::string unitOf(const std::string& path) { return path.substr(0, path.rfind('.')); }

class Cycles {
  public:
    Cycles() {
        for (const File& file : files())
            for (const std::string& included : file.ours)
                if (unitOf(included) != unitOf(file.path))
                    uses_[unitOf(file.path)].insert(unitOf(included));
        for (const auto& [unit, used] : uses_)
            visit(unit);
    }
    const std::vector<std::string>& found() const { return found_; }

  private:
    void visit(const std::string& unit) {
        if (finished_.contains(unit))
            return;
        if (const auto begin = std::find(path_.begin(), path_.end(), unit); begin != path_.end()) {
            std::string cycle;
            for (auto at = begin; at != path_.end(); ++at)
                cycle += *at + " -> ";
            found_.push_back(cycle + unit);
            return;
        }
        path_.push_back(unit);
        if (const auto used = uses_.find(unit); used != uses_.end())
            for (const std::string& next : used->second)
                visit(next);
        path_.pop_back();
        finished_.insert(unit);
    }

    std::map<std::string, Rooms> uses_;
    std::vector<std::string> path_, found_;
    Rooms finished_;
};

TEST(IncludeRules, NoCyclesBetweenFiles) {
    const Cycles cycles;
    for (const std::string& cycle : cycles.found())
        ADD_FAILURE() << cycle;
}

// Libraries that one room keeps to itself.
const std::map<std::string, Rooms> keepers = {
    {"epoxy/", {"gl"}},
    {"GLFW/", {"gl", "viewer"}},
    {"imgui", {"viewer"}},
    {"backends/imgui", {"viewer"}},
    {"OpenImageIO/", {"image"}},
    {"pango/", {"image", "experiment"}},
    {"tiny_gltf", {"renderer/scene"}},
    {"draco/", {"renderer/scene"}},
    {"meshoptimizer", {"renderer/scene"}},
    {"toml++/", {"protocols"}},
    {"embree", {"renderer/reference"}},
    {"zip.h", {"archive"}},
};

TEST(IncludeRules, LibrariesStayWithTheirKeepers) {
    Rooms met;
    for (const File& file : files())
        for (const std::string& included : file.theirs)
            for (const auto& [prefix, rooms] : keepers)
                if (included.starts_with(prefix) && !file.path.starts_with("tests/")) {
                    met.insert(prefix);
                    EXPECT_TRUE(rooms.contains(roomOf(file.path)))
                        << file.path << " includes " << included;
                }
    EXPECT_EQ(met.size(), keepers.size()); // a renamed library would make this test blind
}

TEST(IncludeRules, OnlyGlCallsOpenGl) {
    const std::regex call(R"(\bgl[A-Z][A-Za-z0-9]+\()");
    for (const File& file : files())
        EXPECT_TRUE(!file.path.ends_with(".cpp") || roomOf(file.path) == "gl" ||
                    file.path.starts_with("tests/") || !std::regex_search(file.text, call))
            << file.path;
}

} // namespace
} // namespace obscura
