#include "viewer/worker.h"

#include "gl/context.h"
#include "renderer/builtin/builtin.h"
#include "renderer/render.h"
#include "viewer/loader.h"
#include "viewer/painter.h"
#include "viewer/tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

namespace obscura {

namespace {

using Clock = std::chrono::steady_clock;

// A reference is begun once nothing else has been asked for that long: what it starts from takes as
// long to make as several pictures.
constexpr auto restBeforeTracing = std::chrono::milliseconds(120);
// Pictures that follow each other within this are frames of one motion.
constexpr auto longestPause = std::chrono::milliseconds(100);

struct Overtaken {}; // thrown where a wish is given up for a newer one

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// What goes on at the moment, and how long it may take.
struct Doing {
    Status::Doing doing = Status::Doing::nothing;
    std::string what;
    double doneBefore = 0, share = 0; // of all, when it began; and its own
    double expectedSeconds = 0;       // 0: not known
    Clock::time_point since = Clock::now();
};

} // namespace

struct Worker::State {
    explicit State(Notify tell) : notify(std::move(tell)) {}

    void run(const MakeContext& makeContext);
    void loop(Painter& painter);
    bool hasWork() const;
    bool canDraw() const;
    bool needsTracing() const;
    void openLoaded(Painter& painter, Loaded loaded);
    void drawWish(Painter& painter, std::unique_lock<std::mutex>& lock);
    void draw(Painter& painter, const Wanted& wish, bool ofUser);
    void refresh(Painter& painter);
    void beginTracing(Painter& painter);
    void answerProbe(Painter& painter);
    void compare(Painter& painter);
    void say(Doing what);
    void change(); // something that callers see has changed: tells them

    const Notify notify;

    mutable std::mutex mutex; // of all below but what says otherwise
    std::condition_variable wake;    // the drawing thread
    std::condition_variable changed; // who waits until all is drawn
    bool ending = false, dead = false;
    SceneId ids = 0;     // given so far
    SceneId opening = 0; // being opened; 0: none
    std::optional<Wanted> wish;        // not begun
    std::optional<Wanted> last;        // the newest that was begun
    bool busy = false;                 // the drawing thread is at work
    bool traced = false, probing = false, judged = false; // something new of each is to be shown
    std::optional<std::array<int, 2>> probePixel;
    std::shared_ptr<const Opened> opened;
    std::shared_ptr<const Drawn> drawn;
    std::optional<Probed> probed;
    Doing doing;
    std::string openError, drawError, traceError;
    // Tracing of the last wish begins then; none: it has begun, or there is none.
    std::optional<Clock::time_point> tracingDue;

    // The drawing thread's own.
    std::shared_ptr<const RayTracer> rays;
    std::uint64_t tracedView = 0;
    std::vector<TruthKind> tracedKinds;
    std::uint64_t pictures = 0;
    Clock::time_point lastPicture{};
    std::uint64_t comparedPicture = 0;
    int comparedRays = 0;

    std::optional<Loader> loader; // guarded by its own
    std::optional<Tracer> tracer; // the same
    std::jthread thread;          // last: it uses all of the above
};

} // namespace obscura
