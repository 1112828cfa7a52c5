#include "viewer/painter.h"

#include "gl/context.h"
#include "protocols/reader/manifest.h"
#include "renderer/reference/traced.h"
#include "viewer/painter_state.h"
#include "viewer/seconds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>

namespace obscura {

namespace {

bool needsLight(const Wanted& wanted) {
    return wanted.show == Show::lit || wanted.show == Show::error || wanted.show == Show::jod ||
           wanted.reference ||
           std::any_of(wanted.panes.begin(), wanted.panes.end(),
                       [](const Settings& settings) { return settings.technique().reads & light; });
}

// Of a ray-traced pane.
std::optional<TruthKind> kindOf(const Settings& settings) {
    if (!(settings.technique().reads & rays))
        return std::nullopt;
    const TraceSettings trace = traceSettings(settings, 0);
    return TruthKind{trace.integral, trace.radius};
}

// Of what the composite does with light, besides visibility.
std::string lookText(const Wanted& wanted) {
    Recipe recipe;
    recipe.level = wanted.level;
    recipe.view.exposure = wanted.view.exposure;
    return recipe.json();
}

void check(const Wanted& wanted, SceneId scene) {
    if (wanted.scene != scene || scene == 0)
        throw Error("expected a wish for the scene that is open");
    if (wanted.panes.empty() || wanted.panes.size() > 4)
        throw Error(fmt::format("expected one to four panes, found {}", wanted.panes.size()));
    if (wanted.width < 1 || wanted.height < 1 || !(wanted.errorScale > 0))
        throw Error(fmt::format("expected pictures of one pixel or more and a scale above 0, found "
                                "{} x {} and {}",
                                wanted.width, wanted.height, wanted.errorScale));
}

} // namespace

Painter::Painter(gl::Timing timing) : state_(std::make_unique<PainterState>(timing)) {}
Painter::~Painter() = default;

void Painter::open(SceneId id, const Scene& scene) {
    Subject subject(scene);
    gl::throwMessages(); // no memory, say
    PainterState& s = *state_;
    s.buffers.reset();
    s.subject.emplace(std::move(subject));
    s.buffers.emplace(*s.subject);
    s.scene = id;
    s.passes.forgetResults();
    s.panes.clear();
    s.references.clear();
    s.judgement = {};
    ++s.view;
}

SceneId Painter::scene() const { return state_->scene; }
const Subject& Painter::subject() const { return *state_->subject; }
std::uint64_t Painter::view() const { return state_->view; }

void Painter::forget() {
    if (!state_->buffers)
        return;
    state_->buffers->forget();
    state_->passes.forgetResults();
    state_->pictures.clear();
}

const Truth* PainterState::truthOf(const std::optional<TruthKind>& kind) const {
    for (const Reference& reference : references)
        if (kind == reference.truth.kind)
            return &reference.truth;
    return nullptr;
}

const gl::Texture& PainterState::referenceTexture() {
    const auto found =
        std::find_if(references.begin(), references.end(),
                     [&](const Reference& each) { return each.truth.kind == referenceKind(); });
    if (!found->texture)
        found->texture = visibilityTexture(*found->truth.visibility);
    return found->texture;
}

// What qualities depend on, but for how many rays there are: those of fewer stay for so long.
std::string PainterState::judged() const {
    std::string text = fmt::format("{} {} {} {}", look, buffers->lightVersion(),
                                   static_cast<int>(wanted.integral), wanted.view.radius);
    for (const auto& [name, value] : numbersOf(wanted.display))
        text += fmt::format(" {}", value);
    for (const PanePasses::Pane* pane : panes)
        text += fmt::format(" {}", pane->settings.technique().reads & rays ? 0 : pane->version);
    return text;
}

bool PainterState::waits(const PanePasses::Pane& pane) const {
    const auto traced = kindOf(pane.settings);
    return (traced && !truthOf(traced)) || (wanted.show == Show::error && !reference()) ||
           (wanted.show == Show::jod && !isJudged());
}

// The time of each pass comes with the pieces of the clock, later.
void PainterState::runTechniques() {
    for (const PanePasses::Pane* pane : panes)
        buffers->drawPadded(wanted, pane->settings);
    clock.mark();
    ran.clear();
    for (PanePasses::Pane* pane : panes)
        if (passes.run(*pane, *buffers, *subject, truthOf(kindOf(pane->settings)), clock))
            ran.push_back(pane);
    bindFrame(buffers->sight().block);
}

const gl::Texture& PainterState::composited(const gl::Texture& visibility, bool sendsLight,
                                            int guard) {
    const std::array size{wanted.width, wanted.height};
    if (!composite || compositeSize != size) {
        composite.emplace(wanted.view, wanted.level, wanted.width, wanted.height, false);
        compositeSize = size;
    }
    composite->restart();
    composite->set(wanted.view, wanted.level);
    composite->draw(buffers->lightBuffers(), visibility, sendsLight, guard,
                    buffers->sight().gbuffer.emission());
    return composite->sum();
}

// What a pane's picture is of, in full.
std::string PainterState::sourceOf(std::size_t index) const {
    const PanePasses::Pane& pane = *panes[index];
    const std::uint64_t gbuffer = buffers->sight().version;
    const std::string size = fmt::format("{} {} {}", scene, wanted.width, wanted.height);
    const Truth* truth = reference();
    switch (wanted.show) {
    case Show::albedo:
    case Show::normals:
    case Show::depth:
        return fmt::format("{} buffer {} {}", size, static_cast<int>(wanted.show), gbuffer);
    case Show::error:
        if (truth)
            return fmt::format("{} error {} {} {} {}", size, pane.version, truth->rays,
                               static_cast<int>(wanted.integral), wanted.errorScale);
        [[fallthrough]];
    case Show::occlusion:
        return fmt::format("{} occlusion {}", size, pane.version);
    case Show::jod:
        if (isJudged())
            return fmt::format("{} jod {} {} {}", size, judgement.of, index,
                               judgement.qualities[index].rays);
        [[fallthrough]];
    case Show::lit:
        break;
    }
    return fmt::format("{} lit {} {} {}", size, pane.version, buffers->lightVersion(), look);
}

void PainterState::show(std::size_t index, const SharedPicture& into) {
    const PanePasses::Pane& pane = *panes[index];
    const GBuffer& gbuffer = buffers->sight().gbuffer;
    const ShowPass::Visibility visibility{*pane.visibility, pane.guard};
    const auto [nearest, farthest] = buffers->depthRange();
    switch (wanted.show) {
    case Show::albedo:
        return showPass.albedo(gbuffer, into);
    case Show::normals:
        return showPass.normals(gbuffer, into);
    case Show::depth:
        return showPass.depth(gbuffer, nearest, farthest, into);
    case Show::error:
        if (reference())
            return showPass.error(visibility, referenceTexture(), gbuffer, wanted.errorScale, into);
        [[fallthrough]];
    case Show::occlusion:
        return showPass.visibility(visibility, into);
    case Show::jod:
        if (isJudged())
            return showPass.jod(jodMaps[index], into);
        [[fallthrough]];
    case Show::lit:
        break;
    }
    showPass.lit(composited(*pane.visibility, pane.passes.sendsLight(), pane.guard), into);
}

std::shared_ptr<const SharedPicture> PainterState::kept(const std::string& from) {
    for (const std::vector<Picture>* known : {&pictures, &older})
        for (const Picture& each : *known)
            if (each.from == from)
                return each.picture;
    return nullptr;
}

std::shared_ptr<const SharedPicture> PainterState::shown(std::size_t index) {
    const std::string from = sourceOf(index);
    std::shared_ptr<const SharedPicture> result = kept(from);
    if (!result) {
        const std::shared_ptr<SharedPicture> fresh = pool.take(wanted.width, wanted.height);
        show(index, *fresh);
        result = fresh;
    }
    pictures.push_back({from, result});
    return result;
}

std::shared_ptr<const SharedPicture> PainterState::difference(const Drawn& drawn) {
    const bool ofLit = wanted.show == Show::lit;
    const std::string from = fmt::format("difference {} of {} and {}", wanted.errorScale,
                                         ofLit ? sourceOf(0) : fmt::to_string(panes[0]->version),
                                         ofLit ? sourceOf(1) : fmt::to_string(panes[1]->version));
    std::shared_ptr<const SharedPicture> result = kept(from);
    if (!result) {
        const std::shared_ptr<SharedPicture> fresh = pool.take(wanted.width, wanted.height);
        if (ofLit)
            showPass.difference(*drawn.panes[0].picture, *drawn.panes[1].picture, wanted.errorScale,
                                *fresh);
        else
            showPass.difference({*panes[0]->visibility, panes[0]->guard},
                                {*panes[1]->visibility, panes[1]->guard}, buffers->sight().gbuffer,
                                wanted.errorScale, *fresh);
        result = fresh;
    }
    pictures.push_back({from, result});
    return result;
}

Drawn PainterState::summary() const {
    Drawn drawn;
    drawn.wanted = wanted;
    drawn.draft = !buffers->sight().sharp;
    drawn.gbufferMs = gbufferMs;
    drawn.lightMs = lightMs;
    const Truth* truth = needsReference() ? reference() : nullptr;
    drawn.referenceRays = truth ? truth->rays : 0;
    for (std::size_t i = 0; i < panes.size(); ++i) {
        PaneDrawn pane;
        pane.waits = waits(*panes[i]);
        pane.passes = panes[i]->times;
        for (const PassDrawn& pass : pane.passes)
            pane.ms += pass.ms;
        if (needsReference() && isJudged())
            pane.quality = judgement.qualities[i];
        pane.tracing = kindOf(panes[i]->settings).has_value();
        if (const Truth* traced = truthOf(kindOf(panes[i]->settings)))
            pane.rays = traced->rays;
        drawn.panes.push_back(std::move(pane));
    }
    return drawn;
}

Drawn Painter::draw(const Wanted& wanted, const Progress& progress, bool draft) {
    const auto start = std::chrono::steady_clock::now();
    PainterState& s = *state_;
    check(wanted, s.scene);
    // What can fail comes first.
    const bool lit = needsLight(wanted);
    if (lit && !s.buffers->isLit(wanted.level)) {
        if (progress)
            progress({Step::Kind::lighting, wanted.level.name, 0, 1, 0});
        s.buffers->light(wanted.level);
    }
    s.panes = s.passes.take(wanted, progress);

    s.wanted = wanted;
    s.look = lookText(wanted);
    if (s.buffers->see(wanted)) {
        ++s.view;
        s.references.clear();
    }
    s.clock.start();
    const bool drewGBuffer = s.buffers->drawGBuffer(wanted, lit, !draft);
    const std::size_t gbuffer = s.clock.mark();
    const bool drewLight = lit && s.buffers->drawLight();
    const std::size_t lightPiece = s.clock.mark();
    s.runTechniques();
    s.older = std::exchange(s.pictures, {});
    std::vector<std::shared_ptr<const SharedPicture>> pictures;
    for (std::size_t i = 0; i < s.panes.size(); ++i)
        pictures.push_back(s.shown(i));
    const std::vector<double> pieces = s.clock.milliseconds();
    if (drewGBuffer)
        s.gbufferMs = pieces[gbuffer];
    if (drewLight)
        s.lightMs = pieces[lightPiece];
    for (PanePasses::Pane* pane : s.ran)
        for (std::size_t i = 0; i < pane->times.size(); ++i)
            pane->times[i].ms = pieces[pane->firstPiece + i];

    Drawn drawn = s.summary();
    for (std::size_t i = 0; i < pictures.size(); ++i)
        drawn.panes[i].picture = pictures[i];
    if (wanted.difference && pictures.size() > 1)
        drawn.difference = s.difference(drawn);
    s.older.clear();
    gl::finish();
    gl::throwMessages();
    drawn.frameMs = 1000 * secondsSince(start);
    return drawn;
}

std::vector<TruthKind> Painter::truthsWanted() const {
    const PainterState& s = *state_;
    std::vector<TruthKind> kinds;
    if (s.panes.empty())
        return kinds;
    if (s.needsReference())
        kinds.push_back(s.referenceKind());
    for (const PanePasses::Pane* pane : s.panes)
        if (const auto kind = kindOf(pane->settings);
            kind && std::find(kinds.begin(), kinds.end(), *kind) == kinds.end())
            kinds.push_back(*kind);
    return kinds;
}

void Painter::take(std::uint64_t view, std::vector<Truth> truths) {
    PainterState& s = *state_;
    if (view != s.view)
        return;
    std::vector<PainterState::Reference> references;
    for (Truth& truth : truths) {
        const auto known =
            std::find_if(s.references.begin(), s.references.end(), [&](const auto& each) {
                return each.truth.kind == truth.kind && each.truth.rays == truth.rays;
            });
        if (known == s.references.end())
            references.push_back({std::move(truth), {}});
        else
            references.push_back(std::move(*known));
    }
    s.references = std::move(references);
}

void Painter::take(Judgement judgement) {
    PainterState& s = *state_;
    s.jodMaps.clear();
    for (const Image& map : judgement.jodMaps)
        s.jodMaps.push_back(visibilityTexture(map));
    s.judgement = std::move(judgement);
    s.judgement.jodMaps.clear(); // they are textures now
}

} // namespace obscura
