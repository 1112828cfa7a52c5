#include "stimuli/measurements.h"

#include "image/canvas.h"
#include "matching/anchor.h"
#include "metrics/color_video_vdp.h"
#include "stimuli/boost.h"
#include "stimuli/image_files.h"
#include "stimuli/times.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
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

// Adds to a sum of seconds what passes while it lives.
class Stopwatch {
  public:
    explicit Stopwatch(double& sum) : sum_(sum) {}
    ~Stopwatch() {
        sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    double& sum_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The times of the same images, that an earlier manifest has.
void keepTimes(Manifest& manifest, const Manifest& earlier) {
    std::map<std::string, const ImageRecord*> known; // by the recipe's hash
    for (const ConditionRecord& condition : earlier.conditions)
        for (const ImageRecord& image : condition.images)
            known[image.recipe.sha256()] = &image;
    for (ConditionRecord& condition : manifest.conditions)
        for (ImageRecord& image : condition.images)
            if (const auto found = known.find(image.recipe.sha256());
                found != known.end() && renderedOf(*found->second).sha256 == image.image.sha256)
                image.milliseconds = found->second->milliseconds;
}

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
                           RecipeRenderer& renderer, Units& units, std::function<void()> waiting)
    : protocol_(protocol), folder_(std::move(folder)), recipes_(std::move(recipes)),
      renderer_(renderer), units_(units), waiting_(std::move(waiting)) {}

const Measurements::Reference& Measurements::reference(const Recipe& recipe) {
    Reference& known = references_[recipe.sha256()];
    if (known.shown.empty()) {
        known = shared(recipe);
        known.shown = Probe(renderer_.subject(recipe), recipe.view.camera, recipe.width,
                            recipe.height, recipe.normals, recipe.seed)
                          .shown();
    }
    return known;
}

// Its pictures, which this process or another renders. Where another's have gone since, it does so
// for itself.
Measurements::Reference Measurements::shared(const Recipe& recipe) {
    std::optional<Reference> own;
    const auto render = [&] {
        const Rendering rendering = renderer_.render(recipe);
        own = Reference{rendering.image, quantised(rendering.visibility), {}};
    };
    const std::string name = fmt::format("reference-{}", recipe.sha256().substr(0, 16));
    const std::string image = fmt::format("units/{}.png", name),
                      visibility = fmt::format("units/{}_ao.png", name);
    const std::string text = units_.require(
        name,
        [&] {
            render();
            return nlohmann::json{writtenPng(folder_, image, own->image).sha256,
                                  writtenPng(folder_, visibility, own->visibility).sha256}
                .dump();
        },
        waiting_);
    if (own)
        return *own;
    const auto hashes = nlohmann::json::parse(text).get<std::array<std::string, 2>>();
    if (intact(folder_, FileRecord{image, hashes[0]}) &&
        intact(folder_, FileRecord{visibility, hashes[1]}))
        return {readImage8(folder_ / image, 3), readImage8(folder_ / visibility, 1), {}};
    render();
    return *own;
}

// Of the files, whether just written or kept: 8 bits of visibility, whose rounding adds 0.001 to an
// error that is not 0.
void Measurements::addQuality(ConditionRecord& condition) {
    const Stopwatch stopwatch(seconds_);
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
    manifest.timing->method = timing_->reason.substr(0, timing_->reason.find(':'));
    manifest.timing->starcraft[view] = times.starcraft;
    for (ConditionRecord& condition : manifest.conditions)
        for (ImageRecord& image : condition.images)
            if (condition.view == view && isTimed(image.recipe))
                image.milliseconds = times.milliseconds[places.at(timedPart(image.recipe))];
}

void Measurements::addTimes(Manifest& manifest, const std::optional<Manifest>& earlier,
                            const gl::Driver& driver) {
    const Stopwatch stopwatch(seconds_);
    manifest.timing = TimingRecord{"", driver.renderer, processorName(), {}};
    if (earlier && earlier->timing && earlier->timing->renderer == manifest.timing->renderer &&
        earlier->timing->processor == manifest.timing->processor) {
        manifest.timing = earlier->timing;
        keepTimes(manifest, *earlier);
    }
    std::vector<std::string> views; // in the order in which scenes are loaded once
    for (const ConditionRecord& condition : manifest.conditions)
        if (std::find(views.begin(), views.end(), condition.view) == views.end() &&
            std::any_of(condition.images.begin(), condition.images.end(),
                        [](const ImageRecord& image) {
                            return isTimed(image.recipe) && !image.milliseconds;
                        }))
            views.push_back(condition.view);
    std::stable_sort(views.begin(), views.end(), [&](const auto& a, const auto& b) {
        return recipes_.at(a).front().sceneSha256 < recipes_.at(b).front().sceneSha256;
    });
    for (const std::string& view : views)
        time(manifest, view);
}

} // namespace obscura
