#include "viewer/tracer.h"

#include "base/parallel.h"
#include "metrics/color_video_vdp.h"
#include "metrics/flip.h"
#include "metrics/image_error.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>

namespace obscura {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int mostAtOnce =
    32; // rays a pixel between two looks at whether to go on: a second at most

// Threads that this one starts have it too.
void yieldToOthers() {
    const sched_param none{};
    pthread_setschedparam(pthread_self(), SCHED_IDLE,
                          &none); // where it fails, it is slower to share
}

struct Aborted {}; // thrown where rays are traced

// A reference in the making.
struct Making {
    TruthKind kind;
    Image sum; // of visibility times rays
    int rays = 0;
    std::shared_ptr<const Image> mean; // null before any rays
};

// What a set of rays is traced with; whoever has it may go on while others are wanted.
struct Job {
    std::uint64_t generation = 0;
    std::shared_ptr<const RayTracer> scene;
    std::shared_ptr<const Surfaces> surfaces;
    TruthKind kind;
    int rays = 0;  // that there are
    int calls = 1; // of the tracer,
    int each = 2;  // each with so many rays
};

Quality qualityOf(const Comparison::Pane& pane, const Comparison& comparison, Image& jodMap) {
    Quality quality;
    quality.rmse = imageError(pane.visibility, comparison.visibility, comparison.shown).rmse;
    quality.flip = flipError(pane.lit, comparison.lit, comparison.shown).mean;
    PredictedDifference seen =
        predictedDifference(pane.lit, comparison.lit, comparison.display, true);
    quality.jod = seen.jod;
    quality.rays = comparison.rays;
    jodMap = std::move(seen.map);
    return quality;
}

} // namespace

struct Tracer::State {
    explicit State(std::function<void()> tell) : changed(std::move(tell)) {}

    void setKinds(std::vector<TruthKind> kinds);
    std::optional<Job> nextJob() const;
    void traceOn();
    void judgeOn();
    Image traced(const Job& job);
    void add(const Job& job, const Image& sum);
    void tellSometimes();

    std::function<void()> changed;
    const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));

    mutable std::mutex mutex; // of all below but the atomics
    std::condition_variable wake;
    bool ending = false;
    std::uint64_t view = 0;
    std::shared_ptr<const RayTracer> scene;
    std::shared_ptr<const Surfaces> surfaces;
    std::vector<Making> makings;
    std::string error;
    double raysASecond = 0; // a pixel's; 0: not known
    std::optional<Comparison> waiting;
    bool judging = false;
    std::optional<Judgement> judged;

    std::atomic<std::uint64_t> generation{0}; // of what is wanted; with another, rays are aborted
    std::atomic<double> doneOfJob{0};         // share
    std::atomic<Clock::rep> told{0};

    std::jthread tracing, judgingThread; // last: they use all of the above
};

// What is traced for a kind that is no longer wanted is lost.
void Tracer::State::setKinds(std::vector<TruthKind> kinds) {
    std::vector<Making> wanted;
    bool lost = false;
    for (const TruthKind& kind : kinds) {
        const auto known = std::find_if(makings.begin(), makings.end(),
                                        [&](const Making& each) { return each.kind == kind; });
        if (known != makings.end())
            wanted.push_back(std::move(*known));
        else
            wanted.push_back({kind, {}, 0, nullptr});
        lost |= known == makings.end();
    }
    lost |= wanted.size() != makings.size();
    makings = std::move(wanted);
    if (lost)
        ++generation;
    wake.notify_all();
}

// The coarsest reference first.
std::optional<Job> Tracer::State::nextJob() const {
    const auto coarsest =
        std::min_element(makings.begin(), makings.end(),
                         [](const Making& a, const Making& b) { return a.rays < b.rays; });
    if (!surfaces || !error.empty() || coarsest == makings.end() || coarsest->rays >= mostRays)
        return std::nullopt;
    Job job{generation, scene, surfaces, coarsest->kind, coarsest->rays};
    const int more =
        std::min(coarsest->rays == 0 ? 2 * threads : coarsest->rays, mostRays - coarsest->rays);
    job.each = std::clamp(static_cast<int>(std::bit_floor(static_cast<unsigned>(more / threads))),
                          2, mostAtOnce); // the tracer takes powers of two
    job.calls = std::max(more / job.each, 1);
    return job;
}

void Tracer::State::tellSometimes() {
    const Clock::rep now = Clock::now().time_since_epoch().count();
    Clock::rep last = told;
    const Clock::rep quarter = Clock::duration(std::chrono::milliseconds(250)).count();
    if (now - last > quarter && told.compare_exchange_strong(last, now))
        changed();
}

// The sum of the job's sets, each traced by one thread, which stops when something else is wanted.
Image Tracer::State::traced(const Job& job) {
    std::mutex own; // of the two below
    Image sum;
    std::exception_ptr failure;
    const auto work = [&](int call) {
        try {
            TraceSettings settings;
            settings.integral = job.kind.integral;
            settings.radius = job.kind.radius;
            settings.rays = job.each;
            settings.seed =
                static_cast<std::uint64_t>(job.rays + call * job.each + 1) * 0x9e3779b97f4a7c15u;
            settings.threads = 1;
            const auto goesOn = [&](double share) {
                if (generation != job.generation)
                    throw Aborted();
                const double done = (call + share) / job.calls;
                if (done > doneOfJob)
                    doneOfJob = done;
                tellSometimes();
            };
            goesOn(0);
            const Image one = job.scene->trace(*job.surfaces, settings, goesOn).visibility;
            const std::lock_guard lock(own);
            if (sum.pixels.empty())
                sum = Image{one.width, one.height, 1, std::vector<float>(one.pixels.size(), 0.0f)};
            for (std::size_t i = 0; i < one.pixels.size(); ++i)
                sum.pixels[i] += one.pixels[i] * static_cast<float>(job.each);
        } catch (...) {
            const std::lock_guard lock(own);
            failure = std::current_exception();
        }
    };
    forEachInParallel(job.calls, work, {}, std::min(threads, job.calls));
    if (failure)
        std::rethrow_exception(failure);
    return sum;
}

void Tracer::State::add(const Job& job, const Image& sum) {
    const std::lock_guard lock(mutex);
    if (generation != job.generation)
        return;
    for (Making& making : makings) {
        if (!(making.kind == job.kind))
            continue;
        if (making.sum.pixels.empty())
            making.sum =
                Image{sum.width, sum.height, 1, std::vector<float>(sum.pixels.size(), 0.0f)};
        making.rays += job.calls * job.each;
        Image mean = making.sum;
        for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
            making.sum.pixels[i] += sum.pixels[i];
            mean.pixels[i] = making.sum.pixels[i] / static_cast<float>(making.rays);
        }
        making.mean = std::make_shared<const Image>(std::move(mean));
    }
}

void Tracer::State::traceOn() {
    yieldToOthers();
    std::unique_lock lock(mutex);
    for (;;) {
        wake.wait(lock, [&] { return ending || nextJob(); });
        if (ending)
            return;
        const Job job = *nextJob();
        lock.unlock();
        doneOfJob = 0;
        const auto start = Clock::now();
        std::string problem;
        try {
            add(job, traced(job));
        } catch (const Aborted&) {
        } catch (const std::exception& failed) {
            problem = failed.what();
        }
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        lock.lock();
        if (generation == job.generation) {
            error = problem;
            raysASecond = job.calls * job.each / std::max(seconds, 1e-6);
        }
        doneOfJob = 0;
        lock.unlock();
        changed();
        lock.lock();
    }
}

void Tracer::State::judgeOn() {
    yieldToOthers();
    std::unique_lock lock(mutex);
    for (;;) {
        judging = false;
        wake.wait(lock, [&] { return ending || waiting; });
        if (ending)
            return;
        const Comparison comparison = *std::exchange(waiting, std::nullopt);
        judging = true;
        Judgement judgement;
        judgement.of = comparison.of;
        for (const Comparison::Pane& pane : comparison.panes) {
            if (ending || waiting) // overtaken
                break;
            lock.unlock();
            judgement.jodMaps.emplace_back();
            judgement.qualities.push_back(qualityOf(pane, comparison, judgement.jodMaps.back()));
            lock.lock();
        }
        if (judgement.qualities.size() < comparison.panes.size())
            continue;
        judged = std::move(judgement);
        judging = false;
        lock.unlock();
        changed();
        lock.lock();
    }
}

Tracer::Tracer(std::function<void()> changed)
    : state_(std::make_unique<State>(std::move(changed))) {
    state_->tracing = std::jthread([this] { state_->traceOn(); });
    state_->judgingThread = std::jthread([this] { state_->judgeOn(); });
}

Tracer::~Tracer() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->ending = true;
        ++state_->generation;
    }
    state_->wake.notify_all();
}

void Tracer::trace(std::uint64_t view, std::shared_ptr<const RayTracer> scene, Surfaces surfaces,
                   std::vector<TruthKind> kinds) {
    auto shared = std::make_shared<const Surfaces>(std::move(surfaces));
    const std::lock_guard lock(state_->mutex);
    state_->view = view;
    state_->scene = std::move(scene);
    state_->surfaces = std::move(shared);
    state_->makings.clear();
    state_->error.clear();
    state_->raysASecond = 0;
    ++state_->generation;
    state_->setKinds(std::move(kinds));
}

void Tracer::want(std::vector<TruthKind> kinds) {
    const std::lock_guard lock(state_->mutex);
    if (state_->surfaces)
        state_->setKinds(std::move(kinds));
}

void Tracer::stop() {
    const std::lock_guard lock(state_->mutex);
    state_->view = 0;
    state_->scene.reset();
    state_->surfaces.reset();
    state_->makings.clear();
    ++state_->generation;
}

Tracer::Traced Tracer::traced() const {
    const std::lock_guard lock(state_->mutex);
    Traced result;
    result.view = state_->view;
    result.error = state_->error;
    double rays = 0;
    const double all = static_cast<double>(mostRays) * static_cast<double>(state_->makings.size());
    for (const Making& making : state_->makings) {
        rays += making.rays;
        if (making.mean)
            result.truths.push_back({making.kind, making.mean, making.rays});
    }
    if (state_->makings.empty())
        return result;
    if (const auto job = state_->nextJob())
        rays += state_->doneOfJob * job->calls * job->each;
    result.share = rays / all;
    result.secondsLeft = state_->raysASecond > 0 ? (all - rays) / state_->raysASecond
                         : rays < all            ? std::numeric_limits<double>::quiet_NaN()
                                                 : 0;
    return result;
}

void Tracer::judge(Comparison comparison) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->waiting = std::move(comparison);
    }
    state_->wake.notify_all();
}

std::optional<Judgement> Tracer::judgement() {
    const std::lock_guard lock(state_->mutex);
    return std::exchange(state_->judged, std::nullopt);
}

bool Tracer::judging() const {
    const std::lock_guard lock(state_->mutex);
    return state_->judging || state_->waiting;
}

} // namespace obscura
