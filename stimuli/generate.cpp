#include "stimuli/generate.h"

#include "base/files.h"
#include "base/version.h"
#include "image/canvas.h"
#include "matching/anchor.h"
#include "protocols/reader/design.h"
#include "stimuli/boost.h"
#include "stimuli/contact_sheet.h"
#include "stimuli/image_files.h"
#include "stimuli/measurements.h"
#include "stimuli/plan.h"
#include "stimuli/times.h"
#include "stimuli/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// What an interrupted run leaves: a manifest of the pairs that were finished.
constexpr const char* unfinishedName = "unfinished-manifest.json";

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// What earlier runs left.
struct Earlier {
    std::map<std::string, ImageRecord> images; // by the file
    TimingRecord timing;                       // of their times
};

bool timedAlike(const Manifest& earlier, const Manifest& now) {
    return earlier.timing && earlier.timing->renderer == now.timing->renderer &&
           earlier.timing->processor == now.timing->processor;
}

// Of an image of an earlier run, what it is; and what was measured of it, where that was measured
// as it would be now.
ImageRecord recordOf(const ImageRecord& image, const Manifest& earlier, const Manifest& now) {
    ImageRecord record = unboosted(image);
    if (earlier.display != now.display)
        record.quality.reset();
    if (!timedAlike(earlier, now))
        record.milliseconds.reset();
    return record;
}

// A manifest that cannot be read proves nothing, which only costs time.
Earlier earlierRuns(const fs::path& folder, const Manifest& now,
                    std::vector<std::string>& warnings) {
    Earlier earlier{{}, *now.timing};
    for (const char* name : {manifestName, unfinishedName})
        if (fs::exists(folder / name))
            try {
                const Manifest manifest = readManifest(folder / name);
                if (manifest.schemaVersion < 2)
                    warnings.push_back(fmt::format(
                        "{} is of version {}, which does not name the code that rendered: its "
                        "images are made anew",
                        (folder / name).string(), manifest.schemaVersion));
                for (const ConditionRecord& condition : manifest.conditions)
                    for (const ImageRecord& image : condition.images)
                        earlier.images[renderedOf(image).path] = recordOf(image, manifest, now);
                if (timedAlike(manifest, now))
                    earlier.timing = *manifest.timing;
            } catch (const Error&) {
            }
    return earlier;
}

// Whether an earlier record proves that the image need not be rendered.
bool proves(const ImageRecord& earlier, const Recipe& recipe, const fs::path& folder, bool layers) {
    if (earlier.recipe.sha256() != recipe.sha256() || !intact(folder, earlier.image) ||
        !earlier.layers.contains("ao") || (layers && !earlier.layers.contains("linear")))
        return false;
    return std::all_of(earlier.layers.begin(), earlier.layers.end(),
                       [&](const auto& layer) { return intact(folder, layer.second); });
}

Manifest emptyManifest(const Protocol& protocol, const gl::Driver& driver) {
    Manifest manifest;
    manifest.study = protocol.name;
    manifest.title = protocol.title;
    manifest.protocolSha256 = protocol.sha256;
    manifest.stimuliSha256 = sha256(partsOf(protocol).stimuli);
    manifest.commit = std::string(commit());
    manifest.width = protocol.width;
    manifest.height = protocol.height;
    manifest.display = protocol.display;
    manifest.timing = TimingRecord{"", driver.renderer, processorName(), {}};
    return manifest;
}

ConditionRecord emptyPair(const Protocol& protocol, const Condition& condition) {
    ConditionRecord pair;
    pair.condition = condition.id;
    pair.level = condition.level;
    pair.view = condition.view;
    pair.hypothesis = condition.hypothesis;
    pair.radius = protocol.view(condition.view).radius;
    for (const Role& role : condition.roles)
        pair.image(role.name);
    return pair;
}

// Adds each warning once, with the scene that it is about.
void addWarnings(std::vector<std::string>& all, const std::string& scene,
                 const std::vector<std::string>& found) {
    for (const std::string& warning : found)
        if (const std::string full = fmt::format("scene \"{}\": {}", scene, warning);
            std::find(all.begin(), all.end(), full) == all.end())
            all.push_back(full);
}

std::map<std::string, std::vector<Recipe>> byView(const std::vector<Recipe>& recipes) {
    std::map<std::string, std::vector<Recipe>> result;
    for (const Recipe& recipe : recipes)
        result[recipe.view.name].push_back(recipe);
    return result;
}

void add(std::vector<std::string>& all, const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

bool isFinished(const ConditionRecord& condition) {
    return std::none_of(condition.images.begin(), condition.images.end(),
                        [](const ImageRecord& image) { return image.image.path.empty(); });
}

// The conditions of which every image is there.
Manifest finishedPart(Manifest manifest) {
    std::erase_if(manifest.conditions,
                  [](const ConditionRecord& condition) { return !isFinished(condition); });
    return manifest;
}

} // namespace

GenerateResult generate(const Protocol& protocol, const Folders& folders, const fs::path& folder,
                        bool layers, const gl::Driver& driver, const Announce& announce,
                        std::string_view code) {
    const std::vector<PlannedImage> images = plan(protocol);
    SceneHashes scenes(folders);
    std::vector<Recipe> recipes; // all first: a mistake shows before the first image, not after
    recipes.reserve(images.size());
    for (const PlannedImage& image : images)
        recipes.push_back(makeRecipe(protocol, protocol.conditions[image.condition], image.member,
                                     scenes, driver, code));
    removeUnfinishedFiles(folder);
    GenerateResult result;
    result.manifest = emptyManifest(protocol, driver);
    result.manifest.folder = folder;
    for (const Condition& condition : protocol.conditions)
        result.manifest.conditions.push_back(emptyPair(protocol, condition));
    const Earlier earlier = earlierRuns(folder, result.manifest, result.warnings);
    result.manifest.timing = earlier.timing;

    RecipeRenderer renderer(folders);
    Measurements measurements(protocol, folder, byView(recipes), renderer);
    Warnings warnings(protocol, renderer);
    std::set<std::string> anew; // conditions of which an image was rendered
    for (std::size_t i = 0; i < images.size(); ++i) {
        const PlannedImage& image = images[i];
        announce(static_cast<int>(i), static_cast<int>(images.size()), image.file);
        const Condition& condition = protocol.conditions[image.condition];
        ConditionRecord& pair = result.manifest.conditions[image.condition];
        const Role& role = condition.roles[static_cast<std::size_t>(image.member)];
        ImageRecord& record = pair.image(role.name);
        const auto known = earlier.images.find(image.file);
        if (known != earlier.images.end() && proves(known->second, recipes[i], folder, layers)) {
            record = known->second;
            ++result.kept;
        } else {
            const bool exrs = layers || (known != earlier.images.end() &&
                                         known->second.layers.contains("linear"));
            const Rendering rendering = renderer.render(recipes[i], exrs);
            addWarnings(result.warnings, condition.view, renderer.sceneWarnings());
            anew.insert(condition.id);
            const double start = seconds();
            record = written(rendering, image.file, folder, exrs);
            result.writing += seconds() - start;
            ++result.rendered;
        }
        record.role = role.name;
        record.name = role.technique;
        record.recipe = recipes[i];
        if (isFinished(pair)) {
            checkMatched(pair, condition.place);
            measurements.complete(result.manifest, pair);
            if (anew.contains(condition.id))
                add(result.warnings, warnings.of(condition, recipesOf(pair)));
            writeManifest(folder / unfinishedName, finishedPart(result.manifest));
        }
    }
    result.times = renderer.times();
    result.measuring = measurements.seconds();

    const double start = seconds();
    if (protocol.boost)
        boostImages(protocol, result.manifest);
    const std::vector<Image8> sheets = contactSheets(result.manifest);
    for (std::size_t i = 0; i < sheets.size(); ++i)
        result.manifest.contactSheets.push_back(
            writtenPng(folder, pageName("contact-sheet", i, sheets.size()), sheets[i]));
    result.writing += seconds() - start;
    writeManifest(folder / manifestName, result.manifest);
    fs::remove(folder / unfinishedName);
    return result;
}

std::vector<std::string> check(const Protocol& protocol, const Folders& folders,
                               const gl::Driver& driver, const Announce& announce) {
    SceneHashes scenes(folders);
    RecipeRenderer renderer(folders);
    Warnings warnings(protocol, renderer);
    std::vector<std::string> found;
    std::vector<std::vector<Recipe>> recipes(protocol.conditions.size());
    const std::vector<PlannedImage> images = plan(protocol);
    for (std::size_t i = 0; i < images.size(); ++i) {
        announce(static_cast<int>(i), static_cast<int>(images.size()), images[i].file);
        const Condition& condition = protocol.conditions[images[i].condition];
        std::vector<Recipe>& own = recipes[images[i].condition];
        own.push_back(makeRecipe(protocol, condition, images[i].member, scenes, driver));
        if (own.size() < condition.roles.size())
            continue;
        add(found, warnings.of(condition, own));
        addWarnings(found, condition.view, renderer.sceneWarnings());
    }
    return found;
}

} // namespace obscura
