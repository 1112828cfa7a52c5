#include "stimuli/generate.h"

#include "base/files.h"
#include "base/version.h"
#include "image/canvas.h"
#include "protocols/reader/design.h"
#include "stimuli/boost.h"
#include "stimuli/contact_sheet.h"
#include "stimuli/measurements.h"
#include "stimuli/plan.h"
#include "stimuli/times.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <span>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr const char* manifestName = "manifest.json";
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

bool intact(const fs::path& folder, const FileRecord& file) {
    return fs::is_regular_file(folder / file.path) && sha256File(folder / file.path) == file.sha256;
}

// Whether an earlier record proves that the image need not be rendered.
bool proves(const ImageRecord& earlier, const Recipe& recipe, const fs::path& folder, bool layers) {
    if (earlier.recipe.sha256() != recipe.sha256() || !intact(folder, earlier.image) ||
        !earlier.layers.contains("ao") || (layers && !earlier.layers.contains("linear")))
        return false;
    return std::all_of(earlier.layers.begin(), earlier.layers.end(),
                       [&](const auto& layer) { return intact(folder, layer.second); });
}

constexpr std::string_view makeAnew = "make the stimuli anew: obscura-stimuli without --verify";

std::span<const std::string> channelNames(int count) {
    static const std::array<std::string, 4> colours{"R", "G", "B", "A"};
    static const std::array<std::string, 1> grey{"V"};
    return count == 1
               ? std::span<const std::string>(grey)
               : std::span<const std::string>(colours).first(static_cast<std::size_t>(count));
}

// Compares bits, so that a NaN equals itself.
bool sameBits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

class ImageWriter {
  public:
    explicit ImageWriter(const fs::path& folder) : folder_(folder) {}

    FileRecord png(const std::string& name, const Image8& image) const {
        writePng(folder_ / name, image);
        return {name, sha256File(folder_ / name)};
    }
    FileRecord exr(const std::string& name, const Image& image) const {
        writeExr(folder_ / name, image, channelNames(image.channels), true);
        return {name, sha256File(folder_ / name)};
    }

  private:
    fs::path folder_;
};

// What `layers` asks for, by kind.
std::map<std::string, const Image*> exrsOf(const Rendering& rendering) {
    std::map<std::string, const Image*> all{{"visibility", &rendering.visibility}};
    for (const auto& [kind, image] : rendering.layers)
        all[kind] = &image;
    return all;
}

ImageRecord write(const Rendering& rendering, const std::string& file, const fs::path& folder,
                  bool layers) {
    const ImageWriter writer(folder);
    const std::string stem = fs::path(file).stem().string();
    ImageRecord record;
    record.inputsSha256 = rendering.inputsSha256;
    record.meanOcclusion = rendering.meanOcclusion;
    record.image = writer.png(file, rendering.image);
    record.layers["ao"] = writer.png(stem + "_ao.png", quantised(rendering.visibility));
    if (layers)
        for (const auto& [kind, image] : exrsOf(rendering))
            record.layers[kind] = writer.exr(fmt::format("{}_{}.exr", stem, kind), *image);
    return record;
}

// Of the images that are there.
void checkMatched(const ConditionRecord& condition, const Place& place) {
    const ImageRecord* first = nullptr;
    for (const ImageRecord& image : condition.images) {
        if (image.image.path.empty())
            continue;
        if (!first)
            first = &image;
        if (image.inputsSha256 != first->inputsSha256)
            throw Error(place,
                        fmt::format("the images are not matched: before occlusion, \"{}\" has "
                                    "the hash {} and \"{}\" {}. The driver does not repeat "
                                    "itself; render with another device of obscura-render "
                                    "--devices",
                                    first->name, first->inputsSha256, image.name,
                                    image.inputsSha256));
    }
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

// Each image of a manifest in turn, with its condition.
template <typename Visit>
void eachImage(const Manifest& manifest, Visit visit) {
    for (const ConditionRecord& condition : manifest.conditions)
        for (const ImageRecord& image : condition.images)
            visit(condition, image);
}

std::string nameOf(const ConditionRecord& condition, const ImageRecord& image) {
    return fmt::format("condition \"{}\", image {}", condition.condition, image.role);
}

// Whether the difference between two recipes may leave the image as it is. If so, the pixels
// decide.
bool decidedByPixels(const std::string& difference) {
    return difference.starts_with("codeSha256: ") || difference.starts_with("shaderSha256: ") ||
           difference.starts_with("programVersion: ");
}

class Verification {
  public:
    Verification(const Protocol& protocol, const Manifest& manifest, const Folders& folders,
                 const gl::Driver& driver)
        : protocol_(protocol), manifest_(manifest), renderer_(folders), scenes_(folders),
          driver_(driver) {}

    void conditions() const;
    void files() const;
    void recipe(const ConditionRecord& pair, const ImageRecord& record, std::string_view code);
    void rendering(const ConditionRecord& pair, const ImageRecord& record);
    int fromOtherCode() const { return fromOtherCode_; }

  private:
    const Condition& condition(const ConditionRecord& pair) const;
    void file(const FileRecord& record) const;
    void driver(const ImageRecord& record) const;
    Place placeOf(const FileRecord& record) const {
        return {(manifest_.folder / record.path).string(), 0, 0, {}};
    }

    const Protocol& protocol_;
    const Manifest& manifest_;
    RecipeRenderer renderer_;
    SceneHashes scenes_;
    const gl::Driver& driver_;
    int fromOtherCode_ = 0;
};

const Condition& Verification::condition(const ConditionRecord& pair) const {
    for (const Condition& each : protocol_.conditions)
        if (each.id == pair.condition)
            return each;
    throw Error(fmt::format("{} has stimuli of the condition \"{}\", which the protocol lacks; {}",
                            (manifest_.folder / manifestName).string(), pair.condition, makeAnew));
}

void Verification::conditions() const {
    if (manifest_.study != protocol_.name)
        throw Error(fmt::format("{} is of the study \"{}\", the protocol of \"{}\"; {}",
                                (manifest_.folder / manifestName).string(), manifest_.study,
                                protocol_.name, makeAnew));
    for (const Condition& each : protocol_.conditions)
        if (std::none_of(manifest_.conditions.begin(), manifest_.conditions.end(),
                         [&](const ConditionRecord& pair) { return pair.condition == each.id; }))
            throw Error(each.place,
                        fmt::format("condition \"{}\" has no stimuli; {}", each.id, makeAnew));
}

void Verification::file(const FileRecord& record) const {
    if (!fs::exists(manifest_.folder / record.path))
        throw Error(placeOf(record), fmt::format("is missing; {}", makeAnew));
    if (!intact(manifest_.folder, record))
        throw Error(placeOf(record),
                    fmt::format("has changed since it was made: its SHA-256 is not "
                                "the manifest's; {}",
                                makeAnew));
}

void Verification::files() const {
    eachImage(manifest_, [&](const ConditionRecord&, const ImageRecord& record) {
        file(record.image);
        for (const auto& [kind, layer] : record.layers)
            file(layer);
    });
    for (const FileRecord& sheet : manifest_.contactSheets)
        file(sheet);
}

void Verification::driver(const ImageRecord& record) const {
    if (record.recipe.glRenderer != driver_.renderer || record.recipe.glVersion != driver_.version)
        throw Error(placeOf(record.image),
                    fmt::format("was made with {} ({}), this is {} ({}): bytes repeat only on the "
                                "same driver",
                                record.recipe.glRenderer, record.recipe.glVersion, driver_.renderer,
                                driver_.version));
}

void Verification::recipe(const ConditionRecord& pair, const ImageRecord& record,
                          std::string_view code) {
    driver(record);
    const Condition& today = condition(pair);
    const auto role = std::find_if(today.roles.begin(), today.roles.end(),
                                   [&](const Role& each) { return each.name == record.role; });
    if (role == today.roles.end())
        throw Error(today.place,
                    fmt::format("{} is not in the protocol; {}", nameOf(pair, record), makeAnew));
    const int member = static_cast<int>(role - today.roles.begin());
    std::vector<std::string> found =
        differences(record.recipe, makeRecipe(protocol_, today, member, scenes_, driver_, code));
    const auto other = std::stable_partition(
        found.begin(), found.end(), [](const std::string& each) { return !decidedByPixels(each); });
    fromOtherCode_ += other != found.end();
    found.erase(other, found.end());
    if (!found.empty())
        throw Error(today.place,
                    fmt::format("{} ({}) was made by another recipe than the protocol gives now: "
                                "{}; {}",
                                nameOf(pair, record), record.image.path, fmt::join(found, "; "),
                                makeAnew));
}

void Verification::rendering(const ConditionRecord& pair, const ImageRecord& record) {
    const bool exrs = record.layers.contains("linear");
    const Rendering now = renderer_.render(record.recipe, exrs);
    const auto mustBe = [&](const FileRecord& file, bool same) {
        if (!same)
            throw Error(placeOf(file),
                        fmt::format("{}: its recipe now gives other pixels, so what renders has "
                                    "changed; {}",
                                    nameOf(pair, record), makeAnew));
    };
    const auto png = [&](const FileRecord& file, const Image8& image) {
        mustBe(file,
               readImage8(manifest_.folder / file.path, image.channels).pixels == image.pixels);
    };
    png(renderedOf(record), now.image);
    const auto images = exrsOf(now);
    for (const auto& [kind, file] : record.layers)
        if (kind == "ao")
            png(file, quantised(now.visibility));
        else if (record.derived && &file == &renderedOf(record))
            continue;
        else if (const auto image = images.find(kind); image == images.end())
            mustBe(file, false);
        else
            mustBe(file, sameBits(readExr(manifest_.folder / file.path,
                                          channelNames(image->second->channels)),
                                  *image->second));
    mustBe(record.image, now.inputsSha256 == record.inputsSha256);
    if (const std::string fault = faultOfBoost(protocol_, manifest_, pair, record); !fault.empty())
        throw Error(placeOf(record.image), fmt::format("{}; {}", fault, makeAnew));
    checkMatched(pair, condition(pair).place);
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
            const double start = seconds();
            record = write(rendering, image.file, folder, exrs);
            result.writing += seconds() - start;
            ++result.rendered;
        }
        record.role = role.name;
        record.name = role.technique;
        record.recipe = recipes[i];
        if (isFinished(pair)) {
            checkMatched(pair, condition.place);
            measurements.complete(result.manifest, pair);
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
            ImageWriter(folder).png(pageName("contact-sheet", i, sheets.size()), sheets[i]));
    result.writing += seconds() - start;
    writeManifest(folder / manifestName, result.manifest);
    fs::remove(folder / unfinishedName);
    return result;
}

void check(const Protocol& protocol, const Folders& folders, const gl::Driver& driver,
           const Announce& announce) {
    SceneHashes scenes(folders);
    RecipeRenderer renderer(folders);
    const std::vector<PlannedImage> images = plan(protocol);
    for (std::size_t i = 0; i < images.size(); ++i) {
        announce(static_cast<int>(i), static_cast<int>(images.size()), images[i].file);
        renderer.check(makeRecipe(protocol, protocol.conditions[images[i].condition],
                                  images[i].member, scenes, driver));
    }
}

int verify(const Protocol& protocol, const Manifest& manifest, const Folders& folders,
           const gl::Driver& driver, const Announce& announce, std::string_view code) {
    Verification verification(protocol, manifest, folders, driver);
    verification.conditions();
    eachImage(manifest, [&](const ConditionRecord& pair, const ImageRecord& record) {
        verification.recipe(pair, record, code);
    });
    verification.files();
    int total = 0, done = 0;
    eachImage(manifest, [&](const ConditionRecord&, const ImageRecord&) { ++total; });
    eachImage(manifest, [&](const ConditionRecord& pair, const ImageRecord& record) {
        announce(done++, total, record.image.path);
        verification.rendering(pair, record);
    });
    return verification.fromOtherCode();
}

} // namespace obscura
