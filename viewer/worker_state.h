#pragma once

#include "viewer/loader.h"
#include "viewer/painter.h"
#include "viewer/seconds.h"
#include "viewer/status.h"
#include "viewer/tracer.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace obscura {

// What the drawing thread is at, and how long it may take.
struct Doing {
    Status::Doing doing = Status::Doing::nothing;
    std::string what;
    int done = 0, all = 1;      // steps like this one
    double expectedSeconds = 0; // of this one; 0: not known
    std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
};

// What the worker's threads share, and what the drawing thread does (drawing_thread.cpp). For the
// worker's own files alone.
struct WorkerState {
    explicit WorkerState(std::function<void()> tell)
        : notify(std::move(tell)), loader([this] { wakeFor(loaded); }),
          tracer([this] { wakeFor(traced); }) {}

    void wakeFor(bool& news);
    bool canDraw() const;
    bool hasWork() const;
    bool idle() const {
        return !busy && !hasWork() && !opening && !wish && !(drawn && drawn->draft && restDue);
    }
    void run(const std::function<std::shared_ptr<void>()>& makeContext);
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

    const std::function<void()> notify;

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
    std::optional<std::chrono::steady_clock::time_point>
        restDue; // when there is something to do at rest

    // The drawing thread's own.
    bool software = false;                 // rasteriser
    std::shared_ptr<const RayTracer> rays; // of the scene that is drawn
    std::uint64_t tracedView = 0;
    std::vector<TruthKind> tracedKinds;
    std::vector<int> shownRays; // by truth
    bool unjudged = false;      // something changed since panes were judged
    std::uint64_t pictures = 0;
    std::chrono::steady_clock::time_point lastPicture{};

    Loader loader; // these guard themselves
    Tracer tracer;
    std::jthread thread; // last: it uses all of the above
};

} // namespace obscura
