#include "stimuli/warnings.h"

#include "metrics/color_video_vdp.h"
#include "renderer/probe.h"
#include "stimuli/measurements.h"
#include "stimuli/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace obscura {

namespace {

constexpr int width = 160;
constexpr int fewRays = 16; // a pixel, for a mean
// Of two images: 63 of 100 would prefer the reference, which 36 people miss more often than not.
constexpr double leastDifference = 0.5; // JOD
constexpr double leastMean = 1;         // of 255: more may be seen as a whole being darker
constexpr double leastSurfaces = 0.05;  // share of pixels
constexpr double leastOcclusion = 0.01; // mean over surfaces

struct Codes {       // how far two images are apart
    int most = 0;    // of 255, in any channel
    double mean = 0; // over all pixels and channels
};

Codes differenceOf(const Image8& a, const Image8& b) {
    Codes result;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const int difference = std::abs(a.pixels[i] - b.pixels[i]);
        result.most = std::max(result.most, difference);
        result.mean += difference;
    }
    result.mean /= static_cast<double>(a.pixels.size());
    return result;
}

double shareOf(const std::vector<bool>& shown) {
    return static_cast<double>(std::count(shown.begin(), shown.end(), true)) /
           static_cast<double>(shown.size());
}

} // namespace

Warnings::Warnings(const Protocol& protocol, RecipeRenderer& renderer)
    : protocol_(protocol), renderer_(renderer) {
    for (const PlannedImage& image : plan(protocol))
        firstOf_.try_emplace(protocol.conditions[image.condition].view, image.condition);
}

const Rendering& Warnings::glance(const Recipe& recipe) {
    Recipe small = recipe;
    small.height = std::max(16, width * recipe.height / recipe.width);
    small.width = width;
    small.antialiasing = 1;
    const auto [known, isNew] = glances_.try_emplace(small.sha256());
    if (isNew)
        known->second = renderer_.render(small);
    return known->second;
}

std::string Warnings::faultOfView(const Condition& condition, std::span<const Recipe> recipes) {
    Recipe reference = referenceOf(protocol_, recipes);
    reference.settings["rays"] = fewRays;
    const Rendering& rendering = glance(reference);
    const Probe probe(renderer_.subject(reference), reference.view.camera, rendering.image.width,
                      rendering.image.height, reference.normals, reference.seed);
    const std::string where =
        fmt::format("condition \"{}\", view \"{}\"", condition.id, condition.view);
    if (const double surfaces = shareOf(probe.shown()); surfaces < leastSurfaces)
        return fmt::format("{}: the view is all but empty; {:.1f} % of the picture shows a "
                           "surface. Move the camera nearer, or point it at the scene",
                           where, 100 * surfaces);
    if (rendering.meanOcclusion < leastOcclusion)
        return fmt::format("{}: next to nothing occludes within the radius of {:g} m; by rays the "
                           "mean occlusion is {:.4f}. Give the scene a larger radius, or look at "
                           "corners and contacts",
                           where, reference.settings.at("radius"), rendering.meanOcclusion);
    return "";
}

// As if small images were magnified until they are as large as the study's.
std::string Warnings::alike(const Condition& condition, const Role& a, const Role& b,
                            const Image8& first, const Image8& second) const {
    Display display = protocol_.display;
    display.distance *= 1.0 * width / protocol_.width;
    const double jod = predictedDifference(first, second, display).jod;
    const Codes difference = differenceOf(first, second);
    if (jod < 10 - leastDifference || difference.mean > leastMean)
        return "";
    return fmt::format(
        "condition \"{}\": images {} ({}) and {} ({}) {}; rendered {} pixels wide they differ by "
        "{} of 255 at most and {:.2f} on average, predicted JOD {:.2f} of 10. People would guess: "
        "take techniques that differ more, a larger radius, or a view with more corners and "
        "contacts",
        condition.id, a.name, a.technique, b.name, b.technique,
        difference.most == 0 ? "are equal" : "look alike", width, difference.most, difference.mean,
        jod);
}

std::vector<std::string> Warnings::of(const Condition& condition, std::span<const Recipe> recipes) {
    std::vector<std::string> found;
    if (protocol_.conditions[firstOf_.at(condition.view)].id == condition.id)
        found.push_back(faultOfView(condition, recipes));
    for (std::size_t i = 0; i < recipes.size(); ++i)
        for (std::size_t j = i + 1; j < recipes.size(); ++j)
            if (const Role& a = condition.roles[i], &b = condition.roles[j];
                condition.correct.empty() && a.technique != b.technique)
                found.push_back(
                    alike(condition, a, b, glance(recipes[i]).image, glance(recipes[j]).image));
    std::erase(found, "");
    return found;
}

std::vector<std::string> ofScene(const std::string& view, const std::vector<std::string>& found) {
    std::vector<std::string> texts;
    for (const std::string& each : found)
        texts.push_back(fmt::format("scene \"{}\": {}", view, each));
    return texts;
}

void addOnce(std::vector<std::string>& all, const std::vector<std::string>& more) {
    for (const std::string& each : more)
        if (std::find(all.begin(), all.end(), each) == all.end())
            all.push_back(each);
}

} // namespace obscura
