#include "gl/context.h"
#include "viewer/worker_state.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

using Clock = std::chrono::steady_clock;

// References are begun, and panes judged, once nothing else has been asked for that long: what
// either starts from takes as long to make as some pictures.
constexpr auto rest = std::chrono::milliseconds(120);
// Pictures that follow each other within this are of one motion.
constexpr auto longestPause = std::chrono::milliseconds(100);

struct Overtaken {}; // thrown where a wish is given up for a newer one

} // namespace

// Other threads say that they have something.
void WorkerState::wakeFor(bool& news) {
    {
        const std::lock_guard lock(mutex);
        news = true;
    }
    wake.notify_one();
    notify();
}

bool WorkerState::canDraw() const { return wish && opened && wish->scene == opened->id; }

bool WorkerState::hasWork() const { return loaded || canDraw() || traced || probing || capture; }

// One for a scene that will never be ready.
void WorkerState::dropForeignWish() {
    if (wish && wish->scene != opening && !canDraw())
        wish.reset();
}

void WorkerState::run(const std::function<std::shared_ptr<void>()>& makeContext) {
    try {
        const std::shared_ptr<void> context = makeContext();
        gl::collectMessages();
        software = gl::currentDriver().software;
        Painter painter(software ? gl::Timing::finish : gl::honestTiming().timing);
        loop(painter);
    } catch (const std::exception& error) {
        const std::lock_guard lock(mutex);
        dead = true;
        drawError = error.what();
    }
    changed.notify_all();
    notify();
}

void WorkerState::loop(Painter& painter) {
    std::unique_lock lock(mutex);
    for (;;) {
        busy = false;
        doing = {};
        changed.notify_all();
        const auto ready = [&] { return ending || hasWork(); };
        bool rested = false;
        if (restDue)
            rested = !wake.wait_until(lock, *restDue, ready);
        else
            wake.wait(lock, ready);
        if (ending)
            return;
        busy = true;
        lock.unlock();
        std::string problem;
        try {
            step(painter, rested);
        } catch (const std::exception& error) { // of reading back, say: no memory
            problem = error.what();
        }
        lock.lock();
        if (!problem.empty())
            drawError = problem;
    }
}

// The most urgent of what there is to do.
void WorkerState::step(Painter& painter, bool rested) {
    std::unique_lock lock(mutex);
    if (std::exchange(loaded, false)) {
        lock.unlock();
        openLoaded(painter);
    } else if (canDraw()) {
        last = *std::exchange(wish, std::nullopt);
        const Wanted wanted = *last;
        const bool draft = software && isMotion(wanted);
        lock.unlock();
        draw(painter, wanted, draft);
        follow(painter);
    } else if (const auto taken = std::exchange(capture, nullptr)) {
        const bool there = drawn && drawn->wanted.scene == painter.scene();
        const std::size_t panes = there ? drawn->panes.size() : 0;
        lock.unlock();
        giveVisibilities(painter, panes, taken);
    } else if (std::exchange(traced, false)) {
        lock.unlock();
        refresh(painter);
    } else if (std::exchange(probing, false)) {
        lock.unlock();
        answerProbe(painter);
    } else if (rested) {
        restDue.reset();
        lock.unlock();
        atRest(painter);
    }
}

void WorkerState::say(Doing what) {
    const bool tells = what.doing != Status::Doing::drawing;
    {
        const std::lock_guard lock(mutex);
        doing = std::move(what);
    }
    if (tells)
        notify();
}

void WorkerState::openLoaded(Painter& painter) {
    std::optional<Loaded> scene = loader.take();
    if (!scene)
        return; // a stage of reading began
    auto result = std::make_shared<Opened>();
    if (scene->error.empty()) {
        say({Status::Doing::loading, fmt::format("{}: to the GPU", nameOf(scene->choice))});
        const auto start = Clock::now();
        try {
            painter.open(scene->id, *scene->scene);
        } catch (const std::exception& error) {
            scene->error = fmt::format("{}: {}", nameOf(scene->choice), error.what());
        }
        *result = {scene->id,
                   scene->choice,
                   scene->scene->sha256,
                   scene->scene->bounds(),
                   scene->scene->indices.size() / 3,
                   scene->scene->cameras,
                   scene->scene->warnings,
                   scene->view.camera,
                   scene->view.radius,
                   scene->view.inside,
                   scene->view.why,
                   scene->seconds + secondsSince(start),
                   scene->view};
    }
    if (scene->error.empty()) {
        tracer.stop();
        tracedView = 0;
        rays = std::move(scene->rays);
    }
    {
        const std::lock_guard lock(mutex);
        if (opening == scene->id)
            opening = 0;
        openError = scene->error;
        if (scene->error.empty()) {
            opened = std::move(result);
            last.reset();
            restDue.reset();
        }
        dropForeignWish();
    }
    notify();
}

// Throws where a newer wish waits, for a step takes long; those done are kept.
void WorkerState::before(const Painter::Step& step) {
    {
        const std::lock_guard lock(mutex);
        if (ending || canDraw())
            throw Overtaken();
    }
    const bool compiles = step.kind == Painter::Step::Kind::compiling;
    say({Status::Doing::compiling, compiles ? step.what : "light and shadows", step.done, step.all,
         step.expectedSeconds});
}

// Nobody else has the pictures yet, but for those that have been copied before.
void WorkerState::copy(const Drawn& picture) {
    const auto copyOne = [](const std::shared_ptr<const SharedPicture>& each) {
        if (each && each->pixels.empty())
            std::const_pointer_cast<SharedPicture>(each)->pixels =
                gl::readBytes(each->texture, each->width, each->height, gl::Format::rgba8);
    };
    for (const PaneDrawn& pane : picture.panes)
        copyOne(pane.picture);
    copyOne(picture.difference);
}

void WorkerState::publish(Drawn picture) {
    if (copies)
        copy(picture);
    const auto now = Clock::now();
    const double taken = picture.frameMs / 1e3;
    const auto since = std::chrono::duration<double>(now - lastPicture).count();
    if (since - taken < std::chrono::duration<double>(longestPause).count())
        picture.intervalMs = since * 1e3;
    lastPicture = now;
    picture.number = ++pictures;
    const auto shared = std::make_shared<const Drawn>(std::move(picture));
    {
        const std::lock_guard lock(mutex);
        drawn = shared;
        drawError.clear();
    }
    notify();
}

// Whether this is the last picture from elsewhere.
bool WorkerState::isMotion(const Wanted& wanted) const {
    return drawn && drawn->wanted.scene == wanted.scene && drawn->wanted.width == wanted.width &&
           drawn->wanted.height == wanted.height &&
           !(drawn->wanted.view.camera == wanted.view.camera);
}

void WorkerState::draw(Painter& painter, const Wanted& wanted, bool draft) {
    say({Status::Doing::drawing, ""});
    std::string problem;
    try {
        publish(painter.draw(
            wanted, [&](const Painter::Step& step) { before(step); }, draft));
    } catch (const Overtaken&) {
        return;
    } catch (const std::exception& error) {
        problem = error.what();
    }
    bool probes = false;
    {
        const std::lock_guard lock(mutex);
        drawError = problem;
        probes = pixel.has_value();
    }
    if (!problem.empty())
        notify();
    else if (probes)
        answerProbe(painter);
}

// What a picture of another wish means for references. What was traced of other views is dropped
// at once, so that nothing is traced in vain while a camera moves.
void WorkerState::follow(Painter& painter) {
    const std::vector<TruthKind> kinds = painter.truthsWanted();
    const bool sameView = painter.view() == tracedView;
    if (tracedView != 0 && (!sameView || kinds.empty())) {
        tracer.stop();
        tracedView = 0;
    }
    unjudged = true;
    const std::lock_guard lock(mutex);
    traceError.clear();
    restDue.reset();
    if (!kinds.empty() || (drawn && drawn->draft))
        restDue = Clock::now() + rest;
}

// Rays, or what came of a comparison.
void WorkerState::refresh(Painter& painter) {
    const Tracer::Traced news = tracer.traced();
    std::optional<Judgement> judgement = tracer.judgement();
    std::vector<int> counts;
    for (const Truth& truth : news.truths)
        counts.push_back(truth.rays);
    const bool finer = news.view == tracedView && tracedView != 0 && counts != shownRays;
    std::optional<Wanted> wanted;
    {
        const std::lock_guard lock(mutex);
        traceError = news.error;
        wanted = last;
    }
    if (finer) {
        painter.take(news.view, news.truths);
        shownRays = counts;
        unjudged = true;
    }
    if (judgement)
        painter.take(std::move(*judgement));
    if (!wanted || wanted->scene != painter.scene() || (!finer && !judgement))
        return;
    draw(painter, *wanted);
    const std::lock_guard lock(mutex);
    if (finer && !restDue)
        restDue = Clock::now(); // to be judged, unless something more urgent waits
}

void WorkerState::atRest(Painter& painter) {
    std::string problem;
    std::optional<Wanted> unsharp;
    {
        const std::lock_guard lock(mutex);
        if (drawn && drawn->draft && last && last->scene == painter.scene())
            unsharp = last;
    }
    if (unsharp)
        draw(painter, *unsharp);
    try {
        const std::vector<TruthKind> kinds = painter.truthsWanted();
        if (kinds.empty() || !rays)
            return;
        if (painter.view() != tracedView) {
            tracedView = painter.view();
            shownRays.clear();
            tracer.trace(tracedView, rays, painter.surfaces(), kinds);
        } else if (kinds != tracedKinds) {
            shownRays.clear();
            tracer.want(kinds);
        }
        tracedKinds = kinds;
        if (std::exchange(unjudged, false))
            if (std::optional<Comparison> comparison = painter.comparison())
                tracer.judge(std::move(*comparison));
    } catch (const std::exception& error) {
        problem = error.what();
    }
    const std::lock_guard lock(mutex);
    if (!problem.empty())
        traceError = problem;
}

void WorkerState::answerProbe(Painter& painter) {
    std::optional<std::array<int, 2>> asked;
    {
        const std::lock_guard lock(mutex);
        asked = pixel;
        probing = false;
    }
    std::optional<Probed> answer;
    if (asked)
        answer = painter.probe((*asked)[0], (*asked)[1]);
    {
        const std::lock_guard lock(mutex);
        probed = std::move(answer);
    }
    notify();
}

void WorkerState::giveVisibilities(Painter& painter, std::size_t panes,
                                   const std::function<void(std::vector<Image>)>& taken) {
    std::vector<Image> images;
    for (std::size_t i = 0; i < panes; ++i)
        images.push_back(painter.visibility(static_cast<int>(i)));
    taken(std::move(images));
    notify();
}

} // namespace obscura
