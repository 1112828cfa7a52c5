#include "bench/sweep/cost_growth.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace obscura {

namespace {

void addRectangle(Scene& scene, glm::vec3 centre, float halfWidth, float halfHeight) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const glm::vec2 corner :
         {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
        scene.vertices.push_back(
            {centre + glm::vec3(corner.x * halfWidth, corner.y * halfHeight, 0),
             {0, 0, 1},
             glm::vec4(0),
             {0, 0}});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
        scene.indices.push_back(first + i);
}

// The techniques' variants in groups of one technique, in the study's order.
std::map<std::string, std::vector<TechniqueSetting>>
byTechnique(const std::vector<TechniqueSetting>& all) {
    std::map<std::string, std::vector<TechniqueSetting>> groups;
    for (const TechniqueSetting& each : all)
        groups[variedName(each.name)].push_back(each);
    return groups;
}

// Each technique's middle variant.
std::vector<TechniqueSetting> middles(const GrowthPlan& plan) {
    std::vector<TechniqueSetting> result;
    for (const auto& [name, variants] : byTechnique(plan.techniques))
        result.push_back(variants[variants.size() / 2]);
    return result;
}

// The last setting of a variant is the one that varies, or all that it has.
double samplesOf(const TechniqueSetting& setting) {
    const std::string& name = setting.name;
    const std::size_t equals = name.rfind('=');
    return equals == std::string::npos ? 1 : std::stod(name.substr(equals + 1));
}

class Measuring {
  public:
    Measuring(const TimingPlan& timing, const std::function<void()>& stepDone)
        : timing_(timing), stepDone_(stepDone) {}

    // Adds a row for each technique; `value` is its place on the axis.
    void measure(const Probe& probe, const std::vector<TechniqueSetting>& techniques, double radius,
                 const std::string& axis,
                 const std::function<double(const TechniqueSetting&)>& value) {
        std::vector<Settings> settings;
        settings.reserve(techniques.size());
        for (const TechniqueSetting& each : techniques)
            settings.push_back(settingsOf(each, radius));
        const auto times = timeTechniques(probe, settings, radius, timing_);
        for (std::size_t i = 0; i < times.size(); ++i)
            rows_.push_back(
                {axis == "samples" ? variedName(techniques[i].name) : techniques[i].name, axis,
                 value(techniques[i]), times[i].total.median});
        stepDone_();
    }

    std::vector<GrowthRow> rows() && { return std::move(rows_); }

  private:
    const TimingPlan& timing_;
    const std::function<void()>& stepDone_;
    std::vector<GrowthRow> rows_;
};

} // namespace

Scene poleField(int poles) {
    Scene scene;
    scene.materials.emplace_back();
    addRectangle(scene, {0, 0, -10}, 12, 8);
    Random random(1, "poles");
    for (int i = 0; i < poles; ++i) {
        const double distance = 3 + 5 * random.uniform(), across = 2 * random.uniform() - 1;
        const auto z = static_cast<float>(-distance);
        addRectangle(scene, {static_cast<float>(across * distance), 0, z}, 0.02f, 8);
    }
    scene.meshes.push_back({0, static_cast<std::uint32_t>(scene.indices.size()), 0});
    return scene;
}

Camera poleFieldCamera() {
    Camera camera;
    camera.target = {0, 0, -10};
    camera.fovDegrees = 60;
    return camera;
}

double silhouettes(const Surfaces& surfaces) {
    double edges = 0;
    for (int y = 0; y + 1 < surfaces.height; ++y)
        for (int x = 0; x + 1 < surfaces.width; ++x) {
            const float depth = surfaces.depth[surfaces.index(x, y)];
            const float right = surfaces.depth[surfaces.index(x + 1, y)],
                        above = surfaces.depth[surfaces.index(x, y + 1)];
            edges += std::max(std::abs(right - depth), std::abs(above - depth)) > 0.05f * depth;
        }
    return edges / ((surfaces.width - 1.0) * (surfaces.height - 1.0));
}

int growthSteps(const GrowthPlan& plan) {
    return static_cast<int>(1 + plan.radii.size() + plan.sizes.size() + plan.poles.size());
}

std::vector<GrowthRow> costGrowth(const GrowthPlan& plan, const View& view, const Subject& subject,
                                  Normals normals, const TimingPlan& timing,
                                  const std::function<void()>& stepDone) {
    Measuring measuring(timing, stepDone);
    const auto typical = middles(plan);
    const auto constant = [](double value) {
        return [value](const TechniqueSetting&) { return value; };
    };
    const ImageSize size = plan.sizes.front();
    const Probe probe(subject, view.camera, size.width, size.height, normals, timing.seed);
    measuring.measure(probe, plan.techniques, view.radius, "samples", samplesOf);
    for (const double radius : plan.radii)
        measuring.measure(probe, typical, radius, "radius", constant(radius));
    for (const ImageSize& each : plan.sizes)
        measuring.measure(
            Probe(subject, view.camera, each.width, each.height, normals, timing.seed), typical,
            view.radius, "pixels", constant(1e-6 * each.width * each.height));
    for (const int poles : plan.poles) {
        const Subject field(poleField(poles));
        const Probe seen(field, poleFieldCamera(), size.width, size.height, normals, timing.seed);
        measuring.measure(seen, typical, view.radius, "silhouettes",
                          constant(silhouettes(seen.surfaces())));
    }
    return std::move(measuring).rows();
}

} // namespace obscura
