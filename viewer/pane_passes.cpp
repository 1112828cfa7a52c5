#include "viewer/pane_passes.h"

#include "renderer/reference/traced.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>

namespace obscura {

namespace {

constexpr std::size_t kept = 12; // compiled techniques, those that are shown included

// Whole numbers are constants of shaders (OcclusionPasses::set).
std::string compiledText(const Settings& settings) {
    std::string text(settings.technique().id);
    for (const Parameter& parameter : settings.technique().parameters)
        if (isWhole(parameter))
            text += fmt::format(" {}", settings[parameter.name]);
    return text;
}

} // namespace

std::vector<double> PieceClock::milliseconds() {
    std::vector<double> pieces = timer_.pieces();
    for (double& piece : pieces)
        piece *= 1e3;
    return pieces;
}

// Not taken yet in this turn.
PanePasses::Pane* PanePasses::known(const Settings& settings, bool exactly) {
    const std::string text = compiledText(settings);
    const auto found = std::find_if(panes_.begin(), panes_.end(), [&](const Pane& pane) {
        return pane.wanted < turn_ && pane.compiled == text &&
               (!exactly || pane.settings.values() == settings.values());
    });
    return found == panes_.end() ? nullptr : &*found;
}

PanePasses::Pane& PanePasses::compiled(const Settings& settings, const Wanted& wanted) {
    const auto start = std::chrono::steady_clock::now();
    const int guard = guardPixels(settings, wanted.height);
    const int width = wanted.width + 2 * guard, height = wanted.height + 2 * guard;
    panes_.emplace_back(settings, OcclusionPasses(settings, width, height));
    panes_.back().compiled = compiledText(settings);
    panes_.back().width = width;
    panes_.back().height = height;
    panes_.back().guard = guard;
    seconds_[std::string(settings.technique().id)] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return panes_.back();
}

void PanePasses::adapt(Pane& pane, const Settings& settings, const Wanted& wanted) {
    pane.settings = settings;
    pane.guard = guardPixels(settings, wanted.height);
    const int width = wanted.width + 2 * pane.guard, height = wanted.height + 2 * pane.guard;
    if (pane.width == width && pane.height == height)
        return;
    pane.passes.resize(width, height);
    pane.width = width;
    pane.height = height;
    pane.from.clear();
}

std::vector<PanePasses::Pane*> PanePasses::take(const Wanted& wanted, const PaintProgress& before) {
    ++turn_;
    std::vector<Pane*> result(wanted.panes.size());
    int missing = 0;
    for (const bool exactly : {true, false})
        for (std::size_t i = 0; i < result.size(); ++i)
            if (!result[i] && (result[i] = known(wanted.panes[i], exactly)))
                result[i]->wanted = turn_;
            else if (!result[i] && !exactly)
                ++missing;
    int done = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (result[i])
            continue;
        const Settings& settings = wanted.panes[i];
        const Technique& technique = settings.technique();
        if (before && !technique.passes.empty())
            before({PaintStep::Kind::compiling, std::string(technique.title), done++, missing,
                    seconds_[std::string(technique.id)]});
        result[i] = &compiled(settings, wanted);
        result[i]->wanted = turn_;
    }
    for (std::size_t i = 0; i < result.size(); ++i)
        adapt(*result[i], wanted.panes[i], wanted);
    while (panes_.size() > kept)
        panes_.erase(
            std::min_element(panes_.begin(), panes_.end(),
                             [](const Pane& a, const Pane& b) { return a.wanted < b.wanted; }));
    return result;
}

bool PanePasses::run(Pane& pane, const ViewBuffers& buffers, const Subject& subject,
                     const Truth* truth, PieceClock& clock) {
    const ViewBuffers::Sight& sight = buffers.sight(pane.guard);
    const unsigned reads = pane.settings.technique().reads;
    std::string from =
        fmt::format("{} {} {} {}", sight.version, reads & light ? buffers.lightVersion() : 0,
                    truth ? truth->rays : 0, fmt::join(pane.settings.values(), " "));
    if (pane.from == from)
        return false;
    pane.passes.set(pane.settings);
    pane.times.clear();
    if (truth) {
        pane.traced = visibilityTexture(shaped(*truth->visibility, pane.settings));
        pane.visibility = &pane.traced;
    } else {
        const OcclusionInputs inputs{sight.gbuffer,
                                     sight.frame,
                                     [&]() -> OcclusionInputs::Light {
                                         return {buffers.lightBuffers(), buffers.lighting()};
                                     },
                                     std::cref(subject.spheres()),
                                     subject.peel(),
                                     &subject.occluders(),
                                     std::cref(subject.triangles()),
                                     std::cref(subject.traced())};
        bindFrame(sight.block);
        if (std::exchange(pane.cold, false)) {
            pane.passes.next(inputs);
            clock.mark();
        }
        // Of the frames that a still picture takes, the last one is timed.
        pane.passes.forget();
        for (int frame = 1; frame < accumulatedFrames(pane.settings); ++frame) {
            pane.passes.next(inputs);
            clock.mark();
        }
        pane.visibility = &pane.passes.next(inputs, [&](const Pass& pass) {
            const std::size_t piece = clock.mark();
            if (pane.times.empty())
                pane.firstPiece = piece;
            pane.times.push_back({std::string(pass.name), pass.work, 0});
        });
    }
    pane.from = std::move(from);
    pane.version = ++versions_;
    return true;
}

void PanePasses::forgetResults() {
    for (Pane& pane : panes_)
        pane.from.clear();
}

} // namespace obscura
