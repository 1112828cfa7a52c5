// Several processes of obscura-stimuli make one folder of stimuli, and are killed meanwhile.
#include "base/files.h"
#include "base/units.h"
#include "protocols/reader/manifest.h"
#include "tests/folder.h"
#include "tests/killed_workers.h"
#include "tests/renderer/scene/small_gltf.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// A floor before a wall, from two places, at two levels: four groups of two pairs.
std::string protocolText() {
    std::string text = R"(name = "shared"
seed = 3
image = { width = 64, height = 36, antialiasing = 1 }
[levels.low]
ambient = [1, 1, 1]
[levels.high]
sky = {}
[techniques.none]
technique = "none"
[techniques.crytek]
technique = "crytek"
[techniques.few]
technique = "blizzard"
[texts]
instructions = "i"
start = "s"
question = "q"
first = "1"
second = "2"
thanks = "t"
)";
    for (const char* view : {"near", "far"})
        text += fmt::format("[scenes.{}]\nfile = \"t.gltf\"\nradius = 0.3\n"
                            "camera = {{ position = [0.4, 0.5, {}], target = [0.3, 0.3, 0] }}\n",
                            view, view == std::string("near") ? 1.5 : 2.5);
    for (const char* view : {"near", "far"})
        for (const char* level : {"low", "high"})
            for (const char* other : {"none", "crytek"})
                text += fmt::format("[[conditions]]\nid = \"{}-{}-{}\"\nscene = \"{}\"\n"
                                    "level = \"{}\"\npair = [\"{}\", \"few\"]\n",
                                    view, level, other, view, level, other);
    return text;
}

[[noreturn]] void makeStimuli(const test::Folder& root, const std::string& out) {
    test::become({OBSCURA_BIN "/obscura-stimuli", root / "shared.toml", "--scenes", root.path(),
                  "--out", root / out},
                 root / (out + ".log"));
}

// All files by their hashes; the manifest's without what differs from run to run.
std::map<std::string, std::string> contentsOf(const fs::path& folder) {
    std::map<std::string, std::string> result;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file())
            result[entry.path().filename().string()] = sha256File(entry.path());
    Manifest manifest = readManifest(folder / "manifest.json");
    for (ConditionRecord& condition : manifest.conditions)
        for (ImageRecord& image : condition.images) {
            EXPECT_TRUE(image.milliseconds) << condition.condition;
            image.milliseconds.reset();
        }
    manifest.timing.reset();
    result["manifest.json"] = manifestText(manifest);
    return result;
}

TEST(SharedStimuli, AreThoseOfOneProcessHoweverManyAreKilled) {
    const test::Folder root;
    const std::vector<float> corner{-9, 0, 0, 9, 0, 0, 0, 0.6f, 0, -9, 0, 0, 0, 0, 9, 9, 0, 0};
    writeFile(root / "t.bin", trianglesBuffer(corner));
    writeFile(root / "t.gltf", trianglesGltf(corner));
    writeFile(root / "shared.toml", protocolText());
    int status = 0;
    const pid_t alone = test::startWorker([&] { makeStimuli(root, "alone"); });
    ASSERT_EQ(::waitpid(alone, &status, 0), alone);
    ASSERT_EQ(status, 0) << readFile(root / "alone.log");

    EXPECT_GT(test::killWorkers(3, 12, 1.2, 1, [&] { makeStimuli(root, "shared"); }), 0);
    EXPECT_EQ(contentsOf(root / "shared"), contentsOf(root / "alone"))
        << readFile(root / "shared.log");
    const UnitsState state = unitsState(root / "shared");
    EXPECT_EQ(state.units, 8 + 2U); // conditions, times, manifest
    EXPECT_EQ(state.done, state.units);
    EXPECT_THAT(state.held, testing::IsEmpty());
    for (const fs::directory_entry& entry : fs::directory_iterator(root / "shared" / "units"))
        EXPECT_THAT(entry.path().filename().string(), testing::Not(testing::HasSubstr("claim")));
}

} // namespace
} // namespace obscura
