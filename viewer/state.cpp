#include "viewer/state.h"

#include "renderer/levels.h"
#include "renderer/techniques/fetches.h"
#include "viewer/navigation.h"
#include "viewer/presets.h"
#include "viewer/worker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura {

const std::vector<std::string>& tabTitles() {
    static const std::vector<std::string> names{"Techniques", "View", "Measure", "Study"};
    return names;
}

State::State() : level(levelNamed("moderate")) {
    view.radius = 0.5; // metres, until a scene suggests another
    for (const char* id : {"none", "gtao", "hbao", "starcraft"})
        panes.emplace_back(technique(id));
}

int paneAt(const State& state, int place) {
    return state.layout == Layout::single ? state.selected : place;
}

Wanted wantedOf(const State& state, const Box& area, double gap) {
    Wanted wanted;
    wanted.scene = state.sceneId;
    wanted.view = state.view;
    wanted.level = state.level;
    wanted.normals = state.normals;
    wanted.textures = state.textures;
    std::tie(wanted.width, wanted.height) = pictureSize(state.layout, area, gap, state.renderScale);
    for (int place = 0; place < panesOf(state.layout); ++place)
        wanted.panes.push_back(state.panes[static_cast<std::size_t>(paneAt(state, place))]);
    wanted.show = state.show;
    wanted.reference = state.reference;
    wanted.integral = state.integral;
    wanted.display = displays()[static_cast<std::size_t>(state.display)];
    wanted.difference = state.layout == Layout::difference;
    wanted.errorScale = state.errorScale;
    return wanted;
}

void adopt(State& state, const Opened& opened, const std::vector<View>& stored) {
    const glm::vec3 extent = opened.bounds.high - opened.bounds.low;
    state.sceneId = opened.id;
    state.size = std::max(static_cast<double>(glm::length(extent)), 1e-6);
    state.speed = walkingSpeed(state.size);
    state.view.camera = opened.camera;
    state.magnification = {};
    setRadius(state, opened.radius);
    state.views = allViews(state.view, opened.cameras, stored);
    state.viewAt = 0;
}

void setTechnique(State& state, int pane, const Technique& technique) {
    Settings settings(technique);
    if (settings.has("radius"))
        settings.set("radius", state.view.radius);
    state.panes[static_cast<std::size_t>(pane)] = settings;
    matchSamples(state);
}

void setRadius(State& state, double metres) {
    state.view.radius = metres;
    for (Settings& settings : state.panes)
        if (settings.has("radius"))
            settings.set("radius", metres);
}

void showView(State& state, int index) {
    state.viewAt = index;
    const View& view = state.views[static_cast<std::size_t>(index)];
    state.view.camera = view.camera;
    state.view.exposure = view.exposure;
    if (view.radius != state.view.radius)
        setRadius(state, view.radius);
}

void cycleViews(State& state, int step) {
    const int count = static_cast<int>(state.views.size());
    if (count > 0)
        showView(state, (state.viewAt + step % count + count) % count);
}

std::string storeView(State& state) {
    View view = state.view;
    const auto taken = [&](const std::string& name) {
        return std::any_of(state.views.begin(), state.views.end(),
                           [&](const View& each) { return each.name == name; });
    };
    int number = 1;
    do
        view.name = fmt::format("stored-{}", number++);
    while (taken(view.name));
    state.views.push_back(view);
    state.viewAt = static_cast<int>(state.views.size()) - 1;
    return view.name;
}

namespace {

constexpr std::array<std::string_view, 5> counts{"samples", "directions", "slices", "rays",
                                                 "steps"};

// The counts times a factor, each rounded and kept in its range.
Settings scaled(const Settings& settings, double factor) {
    Settings result = settings;
    std::vector<const Parameter*> found;
    for (const Parameter& parameter : settings.technique().parameters)
        if (std::find(counts.begin(), counts.end(), parameter.name) != counts.end() &&
            parameter.unit == Unit::count)
            found.push_back(&parameter);
    if (found.empty())
        return result;
    const double each = std::pow(factor, 1.0 / static_cast<double>(found.size()));
    for (const Parameter* parameter : found)
        result.set(parameter->name,
                   std::clamp(std::round(static_cast<double>(settings[parameter->name]) * each),
                              static_cast<double>(parameter->low),
                              static_cast<double>(parameter->high)));
    return result;
}

} // namespace

Settings withFetches(const Settings& settings, double fetches) {
    Settings best = settings;
    const auto distance = [&](const Settings& each) {
        return std::abs(std::log(std::max(fetchesPerPixel(each), 1.0) / std::max(fetches, 1.0)));
    };
    // In steps of 2 %, from a 64th to 64 times as many.
    for (int i = -210; i <= 210; ++i) {
        const Settings candidate = scaled(settings, std::pow(1.02, i));
        if (distance(candidate) < distance(best) - 1e-9)
            best = candidate;
    }
    return best;
}

void matchSamples(State& state) {
    if (!state.sameSamples)
        return;
    const double fetches = fetchesPerPixel(state.panes.front());
    if (fetches < 1) // none, or rays
        return;
    for (std::size_t i = 1; i < state.panes.size(); ++i)
        state.panes[i] = withFetches(state.panes[i], fetches);
}

} // namespace obscura
