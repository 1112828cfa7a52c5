#include "viewer/worker.h"

#include "viewer/worker_state.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

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

Worker::Worker(MakeContext makeContext, Notify notify, bool copies)
    : state_(std::make_unique<WorkerState>(std::move(notify))) {
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
    WorkerState& s = *state_;
    std::unique_lock lock(s.mutex);
    return s.changed.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
        const bool failed = !s.drawError.empty() || !s.traceError.empty();
        return s.dead || (s.idle() && (rays == 0 || failed || !s.drawn || hasRays(*s.drawn, rays)));
    });
}

} // namespace obscura
