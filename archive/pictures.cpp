#include "archive/pictures.h"

#include "archive/paths.h"
#include "base/files.h"
#include "gl/context.h"
#include "matching/anchor.h"
#include "stimuli/again.h"
#include "stimuli/boost.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <tuple>

namespace obscura {

namespace fs = std::filesystem;

namespace {

constexpr double oneCode = 1.0 / 255; // of the 256 values of a channel

struct Pictured {
    const ConditionRecord* condition;
    const ImageRecord* image;
};

// By scene and level, each of which is then loaded once.
std::vector<Pictured> picturesOf(const Manifest& manifest) {
    std::vector<Pictured> all;
    for (const ConditionRecord& condition : manifest.conditions)
        for (const ImageRecord& image : condition.images)
            all.push_back({&condition, &image});
    const auto key = [](const Pictured& picture) {
        const Recipe& recipe = picture.image->recipe;
        return std::tie(recipe.sceneSha256, recipe.environmentSha256, recipe.level.name);
    };
    std::stable_sort(all.begin(), all.end(), [&](const Pictured& one, const Pictured& other) {
        return key(one) < key(other);
    });
    return all;
}

class Again {
  public:
    Again(const WholeStudy& study, const Folders& folders, const gl::Driver& driver)
        : study_(study), driver_(driver), scenes_(folders), renderer_(folders) {}

    // What is wrong with one is told, and does not keep the others from being looked at.
    void look(const Pictured& picture) {
        name_ = fmt::format("stimuli/{} (condition \"{}\", {})", picture.image->image.path,
                            picture.condition->condition, picture.image->role);
        try {
            const Condition& condition = conditionOf(picture);
            if (const std::string why = missing(condition, picture.image->recipe); !why.empty())
                result_.notHere.push_back(why);
            else
                compare(condition, picture);
        } catch (const std::exception& error) {
            differs(error.what());
        }
    }

    Checked result() {
        if (result_.nearly > 0)
            result_.remarks.push_back(fmt::format(
                "pictures that are nearly the same, since {}: RMSE at most {:.2g}, no channel of a "
                "pixel further apart than {:.3g} (of 1)",
                fmt::join(why_, ", "), mostRms_, largest_));
        return std::move(result_);
    }

  private:
    void differs(const std::string& how) {
        result_.differs.push_back(fmt::format("{}: {}", name_, how));
    }

    const Condition& conditionOf(const Pictured& picture) const {
        for (const Condition& condition : study_.protocol.conditions)
            if (condition.id == picture.condition->condition &&
                std::any_of(condition.roles.begin(), condition.roles.end(),
                            [&](const Role& role) { return role.name == picture.image->role; }))
                return condition;
        throw Error("the protocol has no such image");
    }

    // Why the image cannot be rendered here; "" when it can.
    std::string missing(const Condition& condition, const Recipe& recipe) {
        const View& view = study_.protocol.view(condition.view);
        const Level& level = study_.protocol.level(condition.level);
        const bool isBuiltIn = view.file.empty();
        if (!isBuiltIn && (!faultOfPath(view.file).empty() ||
                           !fs::is_regular_file(scenes_.folders().scenes / view.file)))
            return fmt::format("the scene {} is not in {} (--scenes, OBSCURA_SCENES)", view.file,
                               scenes_.folders().scenes.string());
        if (scenes_.of(view) != recipe.sceneSha256)
            return isBuiltIn ? fmt::format("the built-in scene {} of this version is another",
                                           view.builtin)
                             : fmt::format("the scene {} in {} is another", view.file,
                                           scenes_.folders().scenes.string());
        const fs::path image = scenes_.folders().protocol / level.environment;
        if (!level.environment.empty() &&
            (!fs::is_regular_file(image) || sha256File(image) != recipe.environmentSha256))
            return fmt::format("the environment image {} is not in {}, or is another",
                               level.environment, scenes_.folders().protocol.string());
        return "";
    }

    // What may explain other bytes: other code, another driver, another processor where that draws.
    // What else differs from the recipe that the protocol gives is a fault, which this throws.
    std::vector<std::string> excuses(const Condition& condition, const Pictured& picture) {
        const auto role =
            std::find_if(condition.roles.begin(), condition.roles.end(),
                         [&](const Role& each) { return each.name == picture.image->role; });
        std::vector<std::string> found, faults;
        for (const std::string& difference : differences(
                 picture.image->recipe,
                 makeRecipe(study_.protocol, condition,
                            static_cast<int>(role - condition.roles.begin()), scenes_, driver_)))
            if (decidedByPixels(difference))
                add(found, "the code or a shader is another");
            else if (difference.starts_with("gl."))
                add(found, "the driver is another (" + difference + ")");
            else
                faults.push_back(difference);
        if (!faults.empty())
            throw Error(fmt::format("was made by another recipe than the protocol gives: {}",
                                    fmt::join(faults, "; ")));
        const auto& timing = study_.manifest.timing;
        if (driver_.software && (!timing || timing->processor != processorName()))
            add(found, fmt::format("the processor is another ({}, now {})",
                                   timing ? timing->processor : "unknown", processorName()));
        return found;
    }

    static void add(std::vector<std::string>& list, const std::string& text) {
        if (std::find(list.begin(), list.end(), text) == list.end())
            list.push_back(text);
    }

    void compare(const Condition& condition, const Pictured& picture) {
        const ImageRecord& record = *picture.image;
        const std::vector<std::string> why = excuses(condition, picture);
        const Rendering now = renderer_.render(record.recipe, record.layers.contains("linear"));
        const std::vector<OtherPixels> others = otherPixels(study_.manifest, record, now);
        if (const std::string fault =
                faultOfBoost(study_.protocol, study_.manifest, *picture.condition, record);
            !fault.empty())
            throw Error(fault);
        if (others.empty() && (now.inputsSha256 == record.inputsSha256 || !why.empty())) {
            ++result_.same;
            return;
        }
        std::string how; // of what is no rounding
        for (const OtherPixels& other : others)
            if (why.empty() || (other.rms > oneCode && other.file.path.ends_with(".png")))
                how +=
                    fmt::format("{}{}: RMSE {:.3g}, at most {:.3g} (of 1)", how.empty() ? "" : "; ",
                                other.file.path, other.rms, other.largest);
        if (others.empty())
            how = "what lighting reads before occlusion is another";
        if (!how.empty()) {
            differs(fmt::format("rendered again, it has other pixels: {}{}{}", how,
                                why.empty() ? "" : ", more than rounding, although ",
                                fmt::join(why, ", ")));
            return;
        }
        ++result_.nearly;
        for (const OtherPixels& other : others)
            if (other.file.path.ends_with(".png")) {
                mostRms_ = std::max(mostRms_, other.rms);
                largest_ = std::max(largest_, other.largest);
            }
        for (const std::string& one : why)
            add(why_, one);
    }

    const WholeStudy& study_;
    const gl::Driver& driver_;
    SceneHashes scenes_;
    RecipeRenderer renderer_;
    Checked result_{"pictures, rendered again", 0, 0, {}, {}, {}};
    std::string name_;
    std::vector<std::string> why_;
    double mostRms_ = 0, largest_ = 0;
};

} // namespace

Checked picturesAgain(const WholeStudy& study, const fs::path& scenes, const fs::path& folder,
                      const CheckOptions& options) {
    const std::vector<Pictured> pictures = picturesOf(study.manifest);
    std::optional<gl::Context> context;
    try {
        context.emplace(options.device);
    } catch (const Error& error) {
        Checked none{"pictures, rendered again", 0, 0, {}, {}, {}};
        none.notHere.assign(pictures.size(), fmt::format("no OpenGL 4.5 here: {}", error.what()));
        return none;
    }
    Again again(study, {scenes, folder}, context->driver());
    int done = 0;
    for (const Pictured& picture : pictures) {
        options.announce(done++, static_cast<int>(pictures.size()), picture.image->image.path);
        again.look(picture);
    }
    return again.result();
}

} // namespace obscura
