#include "stimuli/measurements.h"

#include "image/canvas.h"
#include "metrics/color_video_vdp.h"
#include "stimuli/times.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace obscura {

namespace {

// A pixel, over all jittered frames: in Sponza, 9.96 predicted JOD from 1024 rays.
constexpr int leastRays = 128;

// Root mean square of the differences of visibility, 8 bits each; 0 where no surface shows.
double rmseOf(const Image8& visibility, const Image8& reference, const std::vector<bool>& shown) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (shown[i]) {
            sum += std::pow((visibility.pixels[i] - reference.pixels[i]) / 255.0, 2);
            ++count;
        }
    return count > 0 ? std::sqrt(sum / count) : 0;
}

// Of the protocol's own ray-traced techniques that are nothing but rays; 0 without any.
int mostRays(const Protocol& protocol) {
    double most = 0;
    for (const TechniqueSetting& each : protocol.techniques)
        if (each.technique == "ray_traced" && each.settings.size() == 1 &&
            each.settings.front().name == "rays")
            most = std::max(most, each.settings.front().value);
    return static_cast<int>(most);
}

// What is timed of a recipe.
std::string timedPart(const Recipe& recipe) {
    std::string text = recipe.technique;
    for (const auto& [name, value] : recipe.settings)
        text += fmt::format(" {} {:a}", name, value);
    return text;
}

bool isTimed(const Recipe& recipe) { return recipe.technique != "ray_traced"; }

bool isThere(const ImageRecord& image) { return !image.image.path.empty(); }

} // namespace

Recipe referenceOf(const Protocol& protocol, std::span<const Recipe> condition) {
    Recipe recipe = condition.front();
    Settings settings(technique("ray_traced"));
    settings.set("radius", recipe.view.radius);
    for (const Recipe& each : condition) // all that have one have the same
        if (const auto own = each.settings.find("radius"); own != each.settings.end())
            settings.set("radius", own->second);
    const int frames = recipe.antialiasing;
    settings.set("rays", std::max(mostRays(protocol), (leastRays + frames - 1) / frames));
    recipe.technique = settings.technique().id;
    recipe.settings = settings.named();
    recipe.shaderSha256 = shaderSha256(settings, recipe.level);
    return recipe;
}

std::vector<Recipe> recipesOf(const ConditionRecord& condition) {
    std::vector<Recipe> recipes;
    for (const ImageRecord& image : condition.images)
        recipes.push_back(image.recipe);
    return recipes;
}

Measurements::Measurements(const Protocol& protocol, std::filesystem::path folder,
                           std::map<std::string, std::vector<Recipe>> recipes,
                           RecipeRenderer& renderer)
    : protocol_(protocol), folder_(std::move(folder)), recipes_(std::move(recipes)),
      renderer_(renderer) {}

const Measurements::Reference& Measurements::reference(const Recipe& recipe) {
    Reference& known = references_[recipe.sha256()];
    if (known.shown.empty()) {
        Rendering rendering = renderer_.render(recipe);
        known.image = std::move(rendering.image);
        known.visibility = quantised(rendering.visibility);
        known.shown = Probe(renderer_.subject(recipe), recipe.view.camera, recipe.width,
                            recipe.height, recipe.normals, recipe.seed)
                          .shown();
    }
    return known;
}

// Of the files, whether just written or kept: 8 bits of visibility, whose rounding adds 0.001 to an
// error that is not 0.
void Measurements::addQuality(ConditionRecord& condition) {
    const Recipe recipe = referenceOf(protocol_, recipesOf(condition));
    for (ImageRecord& image : condition.images) {
        if (image.quality && image.quality->referenceSha256 == recipe.sha256())
            continue;
        const Reference& truth = reference(recipe);
        const Image8 shown = readImage8(folder_ / image.image.path, 3),
                     visibility = readImage8(folder_ / image.layers.at("ao").path, 1);
        image.quality = ImageQuality{rmseOf(visibility, truth.visibility, truth.shown),
                                     predictedDifference(shown, truth.image, protocol_.display).jod,
                                     recipe.sha256()};
    }
}

void Measurements::time(Manifest& manifest, const std::string& view) {
    std::vector<Settings> techniques;
    std::map<std::string, std::size_t> places; // of what is timed, among them
    const std::vector<Recipe>& recipes = recipes_.at(view);
    for (const Recipe& recipe : recipes)
        if (isTimed(recipe) && places.emplace(timedPart(recipe), techniques.size()).second)
            techniques.push_back(settingsOf(recipe));
    const Recipe& one = recipes.front();
    const Probe probe(renderer_.subject(one), one.view.camera, one.width, one.height, one.normals,
                      one.seed);
    if (!timing_)
        timing_ = gl::honestTiming();
    const TechniqueTimes times =
        timesOf(probe, techniques, one.view.radius, timing_->timing, one.seed);
    for (const auto& [part, place] : places)
        times_[view][part] = times.milliseconds[place];
    manifest.timing->method = timing_->reason.substr(0, timing_->reason.find(':'));
    manifest.timing->starcraft[view] = times.starcraft;
}

void Measurements::complete(Manifest& manifest, ConditionRecord& condition) {
    const auto start = std::chrono::steady_clock::now();
    addQuality(condition);
    if (std::any_of(condition.images.begin(), condition.images.end(),
                    [](const ImageRecord& image) {
                        return isTimed(image.recipe) && !image.milliseconds;
                    }) &&
        !times_.contains(condition.view))
        time(manifest, condition.view);
    if (const auto times = times_.find(condition.view); times != times_.end())
        for (ConditionRecord& each : manifest.conditions)
            for (ImageRecord& image : each.images)
                if (each.view == condition.view && isThere(image) && isTimed(image.recipe))
                    image.milliseconds = times->second.at(timedPart(image.recipe));
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace obscura
