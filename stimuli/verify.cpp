#include "base/files.h"
#include "stimuli/again.h"
#include "stimuli/boost.h"
#include "stimuli/generate.h"
#include "stimuli/image_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view makeAnew = "make the stimuli anew: obscura-stimuli without --verify";

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
    const auto refuse = [&](const FileRecord& file) {
        throw Error(placeOf(file),
                    fmt::format("{}: its recipe now gives other pixels, so what renders has "
                                "changed; {}",
                                nameOf(pair, record), makeAnew));
    };
    for (const OtherPixels& other : otherPixels(manifest_, record, now))
        refuse(other.file);
    if (now.inputsSha256 != record.inputsSha256)
        refuse(record.image);
    if (const std::string fault = faultOfBoost(protocol_, manifest_, pair, record); !fault.empty())
        throw Error(placeOf(record.image), fmt::format("{}; {}", fault, makeAnew));
    checkMatched(pair, condition(pair).place);
}

} // namespace

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
