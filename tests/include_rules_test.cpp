// Who may include whom (docs/architecture.md): linking alone does not catch headers.
#include "protocols/files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace obscura {
namespace {

namespace fs = std::filesystem;
const fs::path root = OBSCURA_SOURCE;

// The part of the project that a file belongs to.
std::string partOf(const std::string& path) {
    if (path.starts_with("renderer/gl/"))
        return "gl";
    if (path.starts_with("renderer/image"))
        return "image";
    return path.substr(0, path.find('/'));
}

const std::map<std::string, std::set<std::string>> allowed = {
    {"protocols", {"protocols"}},
    {"image", {"image", "protocols"}},
    {"gl", {"gl", "protocols"}},
    {"renderer", {"renderer", "gl", "image", "protocols"}},
    {"stimuli", {"stimuli", "renderer", "gl", "image", "protocols"}},
    {"experiment", {"experiment", "gl", "image", "protocols"}},
    {"report", {"report", "protocols"}},
    {"analysis", {"analysis", "report", "image", "protocols"}},
    {"bench", {"bench", "stimuli", "report", "renderer", "gl", "image", "protocols"}},
};

// Libraries that one part keeps to itself.
const std::map<std::string, std::set<std::string>> keepers = {
    {"epoxy/", {"gl"}},          {"GLFW/", {"gl"}},          {"OpenImageIO/", {"image"}},
    {"tiny_gltf", {"renderer"}}, {"toml++/", {"protocols"}}, {"embree", {"renderer"}},
};

template <typename Visit>
void forEachInclude(Visit visit) {
    const std::regex include(R"(^#include ["<]([^">]+)[">])");
    for (const auto& [part, parts] : allowed) {
        const fs::path folder = root / (part == "gl" || part == "image" ? "renderer" : part);
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            const std::string path = fs::relative(entry.path(), root).generic_string();
            const std::string extension = entry.path().extension().string();
            if ((extension != ".h" && extension != ".cpp") || partOf(path) != part)
                continue;
            std::istringstream lines(readFile(entry.path()));
            std::smatch match;
            for (std::string line; std::getline(lines, line);)
                if (std::regex_search(line, match, include))
                    visit(path, match[1].str());
        }
    }
}

TEST(IncludeRules, PartsUseOnlyWhatTheyMay) {
    int seen = 0;
    forEachInclude([&](const std::string& file, const std::string& included) {
        if (!fs::exists(root / included) || included.find('/') == std::string::npos)
            return; // a library's
        ++seen;
        EXPECT_TRUE(allowed.at(partOf(file)).contains(partOf(included)))
            << file << " includes " << included;
    });
    EXPECT_GT(seen, 200);
}

TEST(IncludeRules, LibrariesStayWithTheirKeepers) {
    std::set<std::string> met;
    forEachInclude([&](const std::string& file, const std::string& included) {
        for (const auto& [prefix, parts] : keepers)
            if (included.starts_with(prefix)) {
                met.insert(prefix);
                EXPECT_TRUE(parts.contains(partOf(file))) << file << " includes " << included;
            }
    });
    EXPECT_EQ(met.size(), keepers.size()); // a renamed library would make this test blind
}

TEST(IncludeRules, OnlyGlCallsOpenGl) {
    const std::regex call(R"(\bgl[A-Z][A-Za-z0-9]+\()");
    for (const auto& [part, parts] : allowed) {
        if (part == "gl")
            continue;
        const fs::path folder = root / (part == "image" ? "renderer" : part);
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            const std::string path = fs::relative(entry.path(), root).generic_string();
            if (entry.path().extension() != ".cpp" || partOf(path) == "gl")
                continue;
            EXPECT_FALSE(std::regex_search(readFile(entry.path()), call)) << path;
        }
    }
}

} // namespace
} // namespace obscura
