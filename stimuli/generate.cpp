#include "stimuli/generate.h"

#include "protocols/design.h"
#include "protocols/files.h"
#include "protocols/version.h"
#include "stimuli/contact_sheet.h"
#include "stimuli/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr const char* manifestName = "manifest.json";
// What an interrupted run leaves: the same, of the pairs that were finished.
constexpr const char* unfinishedName = "unfinished-manifest.json";

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// The records of earlier runs by the hash of their recipe. A manifest that cannot be read proves
// nothing, which only costs time.
std::map<std::string, ImageRecord> earlierRecords(const fs::path& folder) {
    std::map<std::string, ImageRecord> records;
    for (const char* name : {manifestName, unfinishedName})
        if (fs::exists(folder / name))
            try {
                for (const PairRecord& pair : readManifest(folder / name).pairs)
                    for (const ImageRecord& image : {pair.a, pair.b})
                        records[image.image.path] = image;
            } catch (const Error&) {
            }
    return records;
}

bool intact(const fs::path& folder, const FileRecord& file) {
    return fs::exists(folder / file.path) && sha256File(folder / file.path) == file.sha256;
}

// Whether an earlier record proves that the image need not be rendered.
bool proves(const ImageRecord& earlier, const Recipe& recipe, const fs::path& folder, bool layers) {
    if (earlier.recipe.sha256() != recipe.sha256() || !intact(folder, earlier.image) ||
        (layers && !earlier.layers.contains("linear")))
        return false;
    return std::all_of(earlier.layers.begin(), earlier.layers.end(),
                       [&](const auto& layer) { return intact(folder, layer.second); });
}

class ImageWriter {
  public:
    explicit ImageWriter(const fs::path& folder) : folder_(folder) {}

    FileRecord png(const std::string& name, const Image8& image) const {
        writePng(folder_ / name, image);
        return {name, sha256File(folder_ / name)};
    }
    FileRecord exr(const std::string& name, const Image& image) const {
        static const std::array<std::string, 4> colours{"R", "G", "B", "A"};
        static const std::array<std::string, 1> grey{"V"};
        const auto channels = static_cast<std::size_t>(image.channels);
        writeExr(folder_ / name, image,
                 channels == 1 ? std::span<const std::string>(grey)
                               : std::span<const std::string>(colours).first(channels),
                 true);
        return {name, sha256File(folder_ / name)};
    }

  private:
    fs::path folder_;
};

ImageRecord write(const Rendering& rendering, const std::string& file, const fs::path& folder,
                  bool layers) {
    const ImageWriter writer(folder);
    const std::string stem = fs::path(file).stem().string();
    ImageRecord record;
    record.inputsSha256 = rendering.inputsSha256;
    record.meanOcclusion = rendering.meanOcclusion;
    record.image = writer.png(file, rendering.image);
    record.layers["ao"] = writer.png(stem + "_ao.png", quantised(rendering.visibility));
    if (layers) {
        record.layers["visibility"] = writer.exr(stem + "_visibility.exr", rendering.visibility);
        for (const auto& [kind, image] : rendering.layers)
            record.layers[kind] = writer.exr(fmt::format("{}_{}.exr", stem, kind), image);
    }
    return record;
}

void checkMatched(const PairRecord& pair, const Place& place) {
    if (pair.a.inputsSha256 != pair.b.inputsSha256)
        throw Error(place, fmt::format("the pair is not matched: before occlusion, \"{}\" has the "
                                       "hash {} and \"{}\" {}. The driver does not repeat itself; "
                                       "render with another device of obscura-render --devices",
                                       pair.a.name, pair.a.inputsSha256, pair.b.name,
                                       pair.b.inputsSha256));
}

Manifest emptyManifest(const Protocol& protocol) {
    Manifest manifest;
    manifest.study = protocol.name;
    manifest.title = protocol.title;
    manifest.protocolSha256 = protocol.sha256;
    manifest.stimuliSha256 = sha256(partsOf(protocol).stimuli);
    manifest.commit = std::string(commit());
    manifest.width = protocol.width;
    manifest.height = protocol.height;
    return manifest;
}

PairRecord emptyPair(const Protocol& protocol, const Condition& condition) {
    PairRecord pair;
    pair.condition = condition.id;
    pair.level = condition.level;
    pair.view = condition.view;
    pair.hypothesis = condition.hypothesis;
    pair.radius = protocol.view(condition.view).radius;
    return pair;
}

// Each once, with the scene it is about.
void addWarnings(std::vector<std::string>& all, const std::string& scene,
                 const std::vector<std::string>& found) {
    for (const std::string& warning : found)
        if (const std::string full = fmt::format("scene \"{}\": {}", scene, warning);
            std::find(all.begin(), all.end(), full) == all.end())
            all.push_back(full);
}

// The pairs of which both members are there.
Manifest finishedPart(Manifest manifest) {
    std::erase_if(manifest.pairs, [](const PairRecord& pair) {
        return pair.a.image.path.empty() || pair.b.image.path.empty();
    });
    return manifest;
}

} // namespace

GenerateResult generate(const Protocol& protocol, const Folders& folders, const fs::path& folder,
                        bool layers, const gl::Driver& driver, const Announce& announce) {
    const std::vector<PlannedImage> images = plan(protocol);
    SceneHashes scenes(folders);
    std::vector<Recipe> recipes; // all first: a mistake shows before the first image, not after
    for (const PlannedImage& image : images)
        recipes.push_back(makeRecipe(protocol, protocol.conditions[image.condition], image.member,
                                     scenes, driver));
    removeUnfinishedFiles(folder);
    const auto earlier = earlierRecords(folder);
    GenerateResult result;
    result.manifest = emptyManifest(protocol);
    result.manifest.folder = folder;
    for (const Condition& condition : protocol.conditions)
        result.manifest.pairs.push_back(emptyPair(protocol, condition));

    RecipeRenderer renderer(folders);
    for (std::size_t i = 0; i < images.size(); ++i) {
        const PlannedImage& image = images[i];
        announce(static_cast<int>(i), static_cast<int>(images.size()), image.file);
        const Condition& condition = protocol.conditions[image.condition];
        PairRecord& pair = result.manifest.pairs[image.condition];
        ImageRecord& record = image.member == 0 ? pair.a : pair.b;
        const auto known = earlier.find(image.file);
        if (known != earlier.end() && proves(known->second, recipes[i], folder, layers)) {
            record = known->second;
            ++result.kept;
        } else {
            const Rendering rendering = renderer.render(recipes[i], layers);
            addWarnings(result.warnings, condition.view, renderer.sceneWarnings());
            const double start = seconds();
            record = write(rendering, image.file, folder, layers);
            result.writing += seconds() - start;
            ++result.rendered;
        }
        record.name = condition.pair[static_cast<std::size_t>(image.member)];
        record.recipe = recipes[i];
        if (!pair.a.image.path.empty() && !pair.b.image.path.empty()) {
            checkMatched(pair, condition.place);
            writeManifest(folder / unfinishedName, finishedPart(result.manifest));
        }
    }
    result.times = renderer.times();

    const double start = seconds();
    result.manifest.contactSheet =
        ImageWriter(folder).png("contact-sheet.png", contactSheet(result.manifest));
    result.writing += seconds() - start;
    writeManifest(folder / manifestName, result.manifest);
    fs::remove(folder / unfinishedName);
    return result;
}

void verify(const Manifest& manifest, const Folders& folders, const gl::Driver& driver,
            const Announce& announce) {
    RecipeRenderer renderer(folders);
    const int total = static_cast<int>(manifest.pairs.size()) * 2;
    int done = 0;
    for (const PairRecord& pair : manifest.pairs)
        for (const ImageRecord& record : {pair.a, pair.b}) {
            announce(done++, total, record.image.path);
            const Place place{(manifest.folder / record.image.path).string(), 0, 0, {}};
            if (!intact(manifest.folder, record.image))
                throw Error(place, "does not have the hash that the manifest records; generate the "
                                   "stimuli again");
            if (record.recipe.glRenderer != driver.renderer ||
                record.recipe.glVersion != driver.version)
                throw Error(place,
                            fmt::format("was made with {} ({}), this is {} ({}): bytes repeat only "
                                        "on the same driver",
                                        record.recipe.glRenderer, record.recipe.glVersion,
                                        driver.renderer, driver.version));
            const Rendering rendering = renderer.render(record.recipe);
            if (rendering.image.pixels != readImage8(manifest.folder / record.image.path, 3).pixels)
                throw Error(place, "its recipe now gives other pixels: the program has changed; "
                                   "generate the stimuli again");
        }
}

} // namespace obscura
