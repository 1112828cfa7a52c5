#include "tests/archive/real_study.h"

#include "archive/contents.h"
#include "archive/results.h"
#include "archive/sums.h"
#include "archive/zip.h"
#include "base/files.h"
#include "gl/context.h"
#include "stimuli/generate.h"
#include "tests/renderer/scene/small_gltf.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

namespace obscura::test {

namespace fs = std::filesystem;

namespace {

// A corner of floor and wall in two kinds of light; techniques from a file beside the folder.
constexpr const char* protocolText = R"(name = "tiny"
title = "A corner, for tests"
seed = 3
include = ["../matched/matched.toml"]
image = { width = 64, height = 36, antialiasing = 2 }
[scenes.corner]
file = "corner/t.gltf"
radius = 0.3
camera = { position = [0.4, 0.5, 1.5], target = [0.3, 0.3, 0], fovDegrees = 50 }
[levels.low]
ambient = [1, 1, 1]
[levels.high]
sky = {}
sun = { azimuthDegrees = 20, elevationDegrees = 60 }
[techniques.none]
technique = "none"
[[conditions]]
id = "first"
scene = "corner"
level = "low"
pair = ["crytek", "few"]
simulatedPreference = 0.8
[[conditions]]
id = "second"
scene = "corner"
level = "high"
pair = ["none", "few"]
[trial]
mask = 0.3
[ordering]
participants = 6
[[claims]]
name = "Few look better"
kind = "superior"
conditions = ["first"]
[texts]
instructions = "i"
start = "s"
question = "q"
first = "1"
second = "2"
thanks = "t"
)";

void run(const std::string& command) {
    if (std::system((command + " >/dev/null 2>&1 </dev/null").c_str()) != 0)
        throw std::runtime_error("failed: " + command);
}

RealStudy made() {
    RealStudy study;
    study.root = fs::temp_directory_path() / fmt::format("obscura-real-study-{}", ::getpid());
    fs::remove_all(study.root);
    std::atexit([] { fs::remove_all(realStudy().root); });
    const std::vector<float> corner{-9, 0, 0, 9, 0, 0, 0, 0.6f, 0, -9, 0, 0, 0, 0, 9, 9, 0, 0};
    study.scenes = study.root / "scenes";
    writeFile(study.scenes / "corner/t.bin", trianglesBuffer(corner));
    writeFile(study.scenes / "corner/t.gltf", trianglesGltf(corner));
    writeFile(study.scenes / "corner/LICENSE.txt", "Do what you like.\n");
    writeFile(study.root / "matched/matched.toml",
              "[techniques.crytek]\ntechnique = \"crytek\"\n"
              "[techniques.few]\ntechnique = \"blizzard\"\nsamples = 8\n");
    study.places = {study.root / "p/tiny.toml", study.root / "stimuli", study.root / "data/tiny",
                    study.root / "results"};
    writeFile(study.places.protocol, protocolText);
    {
        const gl::Context context;
        generate(readProtocol(study.places.protocol), {study.scenes, study.root / "p"},
                 study.places.stimuli, false, context.driver(),
                 [](int, int, const std::string&) {});
    }
    run(fmt::format("'{}/obscura-experiment' --protocol '{}' --stimuli '{}' --data '{}' "
                    "--simulate 6 --seed 1",
                    OBSCURA_BIN, study.places.protocol.string(), study.places.stimuli.string(),
                    (study.root / "data").string()));
    makeResults(study.places, study.places.results);
    return study;
}

} // namespace

const RealStudy& realStudy() {
    static const RealStudy study = made();
    return study;
}

StudyPlaces copied(const fs::path& to) {
    const fs::path& root = realStudy().root;
    fs::create_directories(to);
    for (const char* part : {"p", "matched", "stimuli", "data", "results"})
        fs::copy(root / part, to / part, fs::copy_options::recursive);
    return {to / "p/tiny.toml", to / "stimuli", to / "data/tiny", to / "results"};
}

void archived(const StudyPlaces& places, const fs::path& out, bool withScenes) {
    const Contents contents =
        contentsOf(openWholeStudy(places), readResults(places, {}), realStudy().scenes, withScenes);
    NewFiles files = contents.files;
    files[sumsName] = {sumsOf(files)};
    if (out.extension() == ".zip")
        writeZip(out, "tiny", files);
    else
        writeFiles(out, files);
}

std::vector<Checked> checked(const fs::path& archive, const fs::path& scenes) {
    return checkArchive(archive, {scenes, "", [](int, int, const std::string&) {}});
}

void renewSums(const fs::path& archive) {
    fs::remove(archive / sumsName);
    NewFiles files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(archive))
        if (entry.is_regular_file())
            files[fs::relative(entry.path(), archive).generic_string()] = {"", entry.path()};
    writeFile(archive / sumsName, sumsOf(files));
}

void replaceIn(const fs::path& file, const std::string& what, const std::string& by) {
    std::string text = readFile(file);
    ASSERT_NE(text.find(what), text.npos) << what << " in " << file;
    writeFile(file, text.replace(text.find(what), what.size(), by));
}

} // namespace obscura::test
