#include "tests/experiment/tiny_study.h"

#include "base/files.h"
#include "base/random.h"
#include "protocols/reader/design.h"

#include <fmt/format.h>

#include <cstdlib>

namespace obscura::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "obscura-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

const std::vector<double>& tinyPreferences() {
    static const std::vector<double> preferences = {0.5, 0.9, 0.1, 0.7, 0.3, 0.6, 1.0};
    return preferences;
}

namespace {

std::string protocolText(const TinyOptions& options) {
    std::string text =
        fmt::format(R"(name = "tiny-study"
title = "Noise, for tests"
seed = 20100
[image]
width = {}
height = {}
antialiasing = 1
[scenes.box]
builtin = "sculpture"
camera = {{ position = [0, 1, 4], target = [0, 1, 0] }}
radius = 0.5
[levels.low]
ambient = [1, 1, 1]
[techniques.none]
technique = "none"
[techniques.crytek24]
technique = "crytek"
samples = 24
[trial]
mask = {}
minimumView = {}
[ordering]
{}
participants = 3
[texts]
instructions = "Two images follow, one after the other."
start = "Press Space."
question = "Which looked most realistic?"
first = "The first"
second = "The second"
thanks = "Thank you."
{}
[simulation]
positionBias = {}
{}
)",
                    options.width, options.height, options.mask, options.minimumView,
                    options.ordering, options.texts, options.positionBias, options.simulation);
    for (std::size_t i = 0; i < tinyPreferences().size(); ++i)
        text += fmt::format("[[conditions]]\nid = \"c{}\"\nscene = \"box\"\nlevel = \"low\"\n"
                            "pair = [\"none\", \"crytek24\"]\nsimulatedPreference = {}\n{}\n",
                            i + 1, tinyPreferences()[i], options.conditions);
    return text;
}

Image8 noise(const TinyOptions& options, const std::string& name) {
    Image8 image{options.width, options.height, 3, {}};
    Random random(1, name);
    for (int i = 0; i < options.width * options.height * 3; ++i)
        image.pixels.push_back(static_cast<std::uint8_t>(random.below(256)));
    return image;
}

ImageRecord writeImage(const fs::path& folder, const TinyOptions& options, const std::string& file,
                       const std::string& technique) {
    writePng(folder / file, noise(options, file));
    ImageRecord record;
    record.name = technique;
    record.recipe.technique = technique;
    record.recipe.settings = {{"radius", 0.5}, {"samples", 24}};
    record.image = {file, sha256File(folder / file)};
    return record;
}

} // namespace

TinyStudy writeTinyStudy(const fs::path& folder, const TinyOptions& options) {
    const TinyStudy study{folder / "tiny.toml", folder / "stimuli"};
    writeFile(study.protocol, protocolText(options));
    fs::create_directories(study.stimuli);

    Manifest manifest;
    manifest.study = "tiny-study";
    manifest.title = "Noise, for tests";
    const Protocol protocol = readProtocol(study.protocol);
    manifest.protocolSha256 = protocol.sha256;
    manifest.stimuliSha256 = sha256(partsOf(protocol).stimuli);
    manifest.commit = "unknown";
    manifest.width = options.width;
    manifest.height = options.height;
    for (std::size_t i = 0; i < tinyPreferences().size(); ++i) {
        ConditionRecord pair;
        pair.condition = fmt::format("c{}", i + 1);
        pair.level = "low";
        pair.view = "box";
        pair.hypothesis = "H1";
        pair.images.push_back(
            writeImage(study.stimuli, options, pair.condition + "_a.png", "none"));
        pair.images.back().role = "a";
        pair.images.push_back(
            writeImage(study.stimuli, options, pair.condition + "_b.png", "crytek24"));
        pair.images.back().role = "b";
        manifest.conditions.push_back(std::move(pair));
    }
    writeManifest(study.stimuli / "manifest.json", manifest);
    return study;
}

} // namespace obscura::test
