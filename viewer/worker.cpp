#include "viewer/worker.h"

#include "gl/context.h"
#include "viewer/loader.h"
#include "viewer/painter.h"
#include "viewer/tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace obscura {

namespace {

using Clock = std::chrono::steady_clock;

// References are begun, and panes judged, once nothing else has been asked for that long: what
// either starts from takes as long to make as some pictures.
constexpr auto rest = std::chrono::milliseconds(120);
// Pictures that follow each other within this are of one motion.
constexpr auto longestPause = std::chrono::milliseconds(100);

struct Overtaken {}; // thrown where a wish is given up for a newer one

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// What the drawing thread is at, and how long it may take.
struct Doing {
    Status::Doing doing = Status::Doing::nothing;
    std::string what;
    int done = 0, all = 1;      // steps like this one
    double expectedSeconds = 0; // of this one; 0: not known
    Clock::time_point since = Clock::now();
};

bool wantsReference(const Wanted& wanted) {
    return wanted.reference || wanted.show == Show::error || wanted.show == Show::jod;
}

// Whether the picture is as good as so many rays make it.
bool hasRays(const Drawn& drawn, int rays) {
    const bool reference = wantsReference(drawn.wanted);
    return std::all_of(drawn.panes.begin(), drawn.panes.end(), [&](const PaneDrawn& pane) {
        return (!reference || (pane.quality && pane.quality->rays >= rays)) &&
               (!pane.tracing || pane.rays >= rays);
    });
}

} // namespace

struct Worker::State {
    explicit State(Notify tell)
        : notify(std::move(tell)), loader([this] { wakeFor(loaded); }),
          tracer([this] { wakeFor(traced); }) {}

    void wakeFor(bool& news);
    bool canDraw() const;
    bool hasWork() const;
    bool idle() const {
        return !busy && !hasWork() && !opening && !wish && !(drawn && drawn->draft && restDue);
    }
    void run(const MakeContext& makeContext);
    void loop(Painter& painter);
    void step(Painter& painter, bool rested);
    void openLoaded(Painter& painter);
    void draw(Painter& painter, const Wanted& wanted, bool draft = false);
    bool isMotion(const Wanted& wanted) const;
    void follow(Painter& painter);
    void refresh(Painter& painter);
    void atRest(Painter& painter);
    void answerProbe(Painter& painter);
    void giveVisibilities(Painter& painter, std::size_t panes,
                          const std::function<void(std::vector<Image>)>& taken);
    void say(Doing what);
    void before(const Painter::Step& step);
    void publish(Drawn picture);
    static void copy(const Drawn& picture);
    void dropForeignWish();

    const Notify notify;

    mutable std::mutex mutex;        // of all below, as far as nothing else is said
    std::condition_variable wake;    // the drawing thread
    std::condition_variable changed; // those who wait until all is drawn
    bool copies = false, ending = false, dead = false, busy = true;
    SceneId ids = 0;                                      // given so far
    SceneId opening = 0;                                  // being opened; 0: none
    std::optional<Wanted> wish;                           // not begun
    std::optional<Wanted> last;                           // the newest that was begun
    bool loaded = false, traced = false, probing = false; // there may be something new of each
    std::optional<std::array<int, 2>> pixel;              // to probe
    std::function<void(std::vector<Image>)> capture;      // null: none is waited for
    std::shared_ptr<const Opened> opened;
    std::shared_ptr<const Drawn> drawn;
    std::optional<Probed> probed;
    Doing doing;
    std::string openError, drawError, traceError;
    std::optional<Clock::time_point> restDue; // when there is something to do at rest

    // The drawing thread's own.
    bool software = false;                 // rasteriser
    std::shared_ptr<const RayTracer> rays; // of the scene that is drawn
    std::uint64_t tracedView = 0;
    std::vector<TruthKind> tracedKinds;
    std::vector<int> shownRays; // by truth
    bool unjudged = false;      // something changed since panes were judged
    std::uint64_t pictures = 0;
    Clock::time_point lastPicture{};

    Loader loader; // these guard themselves
    Tracer tracer;
    std::jthread thread; // last: it uses all of the above
};

// Other threads say that they have something.
void Worker::State::wakeFor(bool& news) {
    {
        const std::lock_guard lock(mutex);
        news = true;
    }
    wake.notify_one();
    notify();
}

bool Worker::State::canDraw() const { return wish && opened && wish->scene == opened->id; }

bool Worker::State::hasWork() const { return loaded || canDraw() || traced || probing || capture; }

// One for a scene that will never be ready.
void Worker::State::dropForeignWish() {
    if (wish && wish->scene != opening && !canDraw())
        wish.reset();
}

void Worker::State::run(const MakeContext& makeContext) {
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

void Worker::State::loop(Painter& painter) {
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
void Worker::State::step(Painter& painter, bool rested) {
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

void Worker::State::say(Doing what) {
    const bool tells = what.doing != Status::Doing::drawing;
    {
        const std::lock_guard lock(mutex);
        doing = std::move(what);
    }
    if (tells)
        notify();
}

void Worker::State::openLoaded(Painter& painter) {
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
void Worker::State::before(const Painter::Step& step) {
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
void Worker::State::copy(const Drawn& picture) {
    const auto copyOne = [](const std::shared_ptr<const SharedPicture>& each) {
        if (each && each->pixels.empty())
            std::const_pointer_cast<SharedPicture>(each)->pixels =
                gl::readBytes(each->texture, each->width, each->height, gl::Format::rgba8);
    };
    for (const PaneDrawn& pane : picture.panes)
        copyOne(pane.picture);
    copyOne(picture.difference);
}

void Worker::State::publish(Drawn picture) {
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
bool Worker::State::isMotion(const Wanted& wanted) const {
    return drawn && drawn->wanted.scene == wanted.scene && drawn->wanted.width == wanted.width &&
           drawn->wanted.height == wanted.height &&
           !(drawn->wanted.view.camera == wanted.view.camera);
}

void Worker::State::draw(Painter& painter, const Wanted& wanted, bool draft) {
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
void Worker::State::follow(Painter& painter) {
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
void Worker::State::refresh(Painter& painter) {
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

void Worker::State::atRest(Painter& painter) {
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

void Worker::State::answerProbe(Painter& painter) {
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

void Worker::State::giveVisibilities(Painter& painter, std::size_t panes,
                                     const std::function<void(std::vector<Image>)>& taken) {
    std::vector<Image> images;
    for (std::size_t i = 0; i < panes; ++i)
        images.push_back(painter.visibility(static_cast<int>(i)));
    taken(std::move(images));
    notify();
}

Worker::Worker(MakeContext makeContext, Notify notify, bool copies)
    : state_(std::make_unique<State>(std::move(notify))) {
    state_->copies = copies;
    state_->thread =
        std::jthread([state = state_.get(), make = std::move(makeContext)] { state->run(make); });
}

Worker::~Worker() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->ending = true;
    }
    state_->wake.notify_one();
}

SceneId Worker::open(SceneChoice choice) {
    SceneId id = 0;
    {
        const std::lock_guard lock(state_->mutex);
        id = ++state_->ids;
        state_->opening = id;
        state_->openError.clear();
        state_->dropForeignWish();
    }
    state_->loader.load(id, std::move(choice));
    return id;
}

void Worker::abortOpening() {
    state_->loader.abort();
    {
        const std::lock_guard lock(state_->mutex);
        state_->opening = 0;
        state_->dropForeignWish();
    }
    state_->changed.notify_all();
    state_->notify();
}

void Worker::want(Wanted wanted) {
    {
        const std::lock_guard lock(state_->mutex);
        const std::optional<Wanted>& newest = state_->wish ? state_->wish : state_->last;
        if (newest && *newest == wanted)
            return;
        state_->wish = std::move(wanted);
        state_->dropForeignWish();
    }
    state_->wake.notify_one();
}

void Worker::probe(std::optional<std::array<int, 2>> pixel) {
    {
        const std::lock_guard lock(state_->mutex);
        if (pixel == state_->pixel)
            return;
        state_->pixel = pixel;
        state_->probed.reset();
        state_->probing = true;
    }
    state_->wake.notify_one();
}

void Worker::capture(std::function<void(std::vector<Image>)> taken) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->capture = std::move(taken);
    }
    state_->wake.notify_one();
}

std::shared_ptr<const Opened> Worker::opened() const {
    const std::lock_guard lock(state_->mutex);
    return state_->opened;
}

std::shared_ptr<const Drawn> Worker::newest() const {
    const std::lock_guard lock(state_->mutex);
    return state_->drawn;
}

std::optional<Probed> Worker::probed() const {
    const std::lock_guard lock(state_->mutex);
    return state_->probed;
}

Status Worker::status() const {
    const std::optional<Loader::Progress> loading = state_->loader.progress();
    const Tracer::Traced traced = state_->tracer.traced();
    Status status;
    const std::lock_guard lock(state_->mutex);
    const Doing& doing = state_->doing;
    status.error = !state_->openError.empty()   ? state_->openError
                   : !state_->drawError.empty() ? state_->drawError
                                                : state_->traceError;
    status.loading = state_->opening != 0;
    status.opened = state_->opened ? state_->opened->id : 0;
    for (const Truth& truth : traced.truths)
        status.rays = std::max(status.rays, truth.rays);
    status.doing = doing.doing;
    status.what = doing.what;
    if (doing.doing == Status::Doing::compiling && doing.expectedSeconds > 0) {
        const double spent = secondsSince(doing.since);
        status.share =
            (doing.done + std::min(spent / doing.expectedSeconds, 0.98)) / std::max(doing.all, 1);
        if (spent < doing.expectedSeconds)
            status.secondsLeft = doing.expectedSeconds * (doing.all - doing.done) - spent;
    } else if (loading) {
        status.doing = Status::Doing::loading;
        status.what = loading->what;
        status.share = loading->share;
        status.secondsLeft = loading->secondsLeft;
    } else if (doing.doing == Status::Doing::nothing && traced.view != 0 && traced.share < 1) {
        status.doing = Status::Doing::tracing;
        status.what = fmt::format("{} of {} rays", status.rays, Tracer::mostRays);
        status.share = traced.share;
        status.secondsLeft = traced.secondsLeft;
    }
    return status;
}

bool Worker::waitUntilDrawn(double seconds, int rays) {
    State& s = *state_;
    std::unique_lock lock(s.mutex);
    return s.changed.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
        const bool failed = !s.drawError.empty() || !s.traceError.empty();
        return s.dead || (s.idle() && (rays == 0 || failed || !s.drawn || hasRays(*s.drawn, rays)));
    });
}

} // namespace obscura
