#include "base/files.h"
#include "renderer/reference/reference_cache.h"
#include "renderer/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// The sources in a hash (code_hash.cmake), relative to the root.
std::set<std::string> sourcesOf(const std::string& function) {
    std::istringstream list(readFile(fs::path(OBSCURA_CODE) / (function + ".files")));
    std::set<std::string> files;
    for (std::string line; std::getline(list, line);)
        files.insert(fs::relative(line, OBSCURA_SOURCE).string());
    return files;
}

// What sources include but what cannot decide a pixel, by the file's name without extension:
// errors, files and where they lie, formats, who we are; and what has a hash of its own.
bool decidesNothing(const std::string& stem) {
    static const std::set<std::string> names{
        "error",   "files", "manifest", "protocol", "markup",  "trial", "progress", "process",
        "version", "code",  "timer",    "window",   "builtin", "study", "shipped"};
    return names.contains(stem);
}

TEST(Code, HashesAreThereAndNotTheSame) {
    EXPECT_EQ(imageCode().size(), 64U);
    EXPECT_EQ(referenceCode().size(), 64U);
    EXPECT_NE(imageCode(), referenceCode());
}

// What decides pixels is hashed with all that it includes, and with what implements that: else a
// change would leave stale images.
TEST(Code, HashesLeaveNothingOut) {
    const std::set<std::string> files = sourcesOf("imageCode");
    for (const char* name :
         {"render.cpp", "occlusion_passes.cpp", "pass_shaders.cpp", "gbuffer.cpp", "light.cpp",
          "composite.cpp", "gltf.cpp", "image.cpp", "target.cpp", "random.cpp", "techniques.cpp"})
        EXPECT_TRUE(std::any_of(files.begin(), files.end(), [&](const std::string& each) {
            return fs::path(each).filename() == name;
        })) << name;
    const std::regex include("(?:^|\n)#include \"([^\"]+)\"");
    for (const std::string& file : files) {
        const std::string text = readFile(fs::path(OBSCURA_SOURCE) / file);
        for (auto at = std::sregex_iterator(text.begin(), text.end(), include);
             at != std::sregex_iterator(); ++at) {
            const fs::path header = (*at)[1].str();
            EXPECT_TRUE(files.contains(header.string()) || decidesNothing(header.stem().string()))
                << file << " includes " << header << ", which imageCode() leaves out";
        }
        fs::path source = file;
        source.replace_extension(".cpp");
        if (fs::exists(fs::path(OBSCURA_SOURCE) / source)) {
            EXPECT_TRUE(files.contains(source.string())) << source;
        }
    }
}

// A technique decides no reference, and a built-in scene has the hash of what it consists of:
// neither may cost hours of rays.
TEST(Code, HashesHoldNoMoreThanTheyMust) {
    for (const char* function : {"imageCode", "referenceCode"})
        for (const std::string& file : sourcesOf(function))
            EXPECT_THAT(file, testing::Not(testing::ContainsRegex("builtin|main|stimuli/|bench/")));
    for (const std::string& file : sourcesOf("referenceCode"))
        EXPECT_THAT(file, testing::Not(testing::ContainsRegex("rows/|techniques\\.cpp|composite")));
}

} // namespace
} // namespace obscura
