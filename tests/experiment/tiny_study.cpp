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
        text += fmt::format(
            "[[conditions]]\nid = \"c{}\"\nscene = \"box\"\nlevel = \"low\"\n"
            "pair = [\"none\", \"crytek24\"]\nhypothesis = \"H1\"\nsimulatedPreference = {}\n{}\n",
            i + 1, tinyPreferences()[i], options.conditions);
    return text;
}

Image8 noise(const Protocol& protocol, const std::string& name) {
    constexpr int grain = 4; // pixels, so that files stay small
    Image8 image{protocol.width, protocol.height, 3, {}};
    Random random(1, name);
    std::vector<std::uint8_t> row;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; y % grain == 0 && x < 3 * image.width; ++x) {
            const auto at = static_cast<std::size_t>(x);
            if (row.size() <= at)
                row.push_back(0);
            row[at] =
                x / 3 % grain == 0 ? static_cast<std::uint8_t>(random.below(256)) : row[at - 3];
        }
        image.pixels.insert(image.pixels.end(), row.begin(), row.end());
    }
    return image;
}

ImageRecord writeImage(const fs::path& folder, const Protocol& protocol, const Condition& condition,
                       const Role& role) {
    const std::string file = fmt::format("{}_{}.png", condition.id, role.name);
    writePng(folder / file, noise(protocol, file));
    ImageRecord record;
    record.role = role.name;
    record.name = role.technique;
    record.recipe.technique = protocol.technique(role.technique).technique;
    record.recipe.settings = {{"radius", protocol.view(condition.view).radius}};
    for (const Setting& setting : protocol.technique(role.technique).settings)
        record.recipe.settings[setting.name] = setting.value;
    record.image = {file, sha256File(folder / file)};
    return record;
}

} // namespace

void writeNoiseStimuli(const Protocol& protocol, const fs::path& folder) {
    fs::create_directories(folder);
    Manifest manifest;
    manifest.study = protocol.name;
    manifest.title = protocol.title;
    manifest.protocolSha256 = protocol.sha256;
    manifest.stimuliSha256 = sha256(partsOf(protocol).stimuli);
    manifest.commit = "unknown";
    manifest.width = protocol.width;
    manifest.height = protocol.height;
    for (const Condition& condition : protocol.conditions) {
        ConditionRecord record;
        record.condition = condition.id;
        record.level = condition.level;
        record.view = condition.view;
        record.hypothesis = condition.hypothesis;
        for (const Role& role : condition.roles)
            record.images.push_back(writeImage(folder, protocol, condition, role));
        manifest.conditions.push_back(std::move(record));
    }
    writeManifest(folder / "manifest.json", manifest);
}

TinyStudy writeTinyStudy(const fs::path& folder, const TinyOptions& options) {
    const TinyStudy study{folder / "tiny.toml", folder / "stimuli"};
    writeFile(study.protocol, protocolText(options));
    writeNoiseStimuli(readProtocol(study.protocol), study.stimuli);
    return study;
}

} // namespace obscura::test
