#pragma once

#include "viewer/status.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace obscura {

struct WorkerState;

// Opens scenes, compiles, draws, traces and judges, on threads of its own, so that whoever asks
// never waits. One thread has an OpenGL context and draws; one reads files; one traces references
// and one judges panes by them, both only with what time others leave (idle priority). While
// nothing changes and every reference is as fine as it gets, all of them sleep.
//
// All member functions may be called from any one thread at a time; none waits for work, only, for
// microseconds, for values to be exchanged. What they return is a value, or is never changed again.
class Worker {
  public:
    // Called on the drawing thread before anything else there: makes a context current that shares
    // objects with the one in which pictures are shown, and returns whatever keeps it so; that is
    // destroyed on the same thread, last. A window's: a hidden GLFW window, made on the main thread
    // with the shown one as `share`; here glfwMakeContextCurrent(hidden), and in the deleter
    // glfwMakeContextCurrent(nullptr). Headless: a gl::Context. When it throws, status().error says
    // so and nothing is ever drawn.
    using MakeContext = std::function<std::shared_ptr<void>()>;
    // Called from any of its threads, at most some thirty times a second unless pictures come
    // faster, whenever newest(), opened(), status() or probed() give something else: to wake a
    // sleeping event loop (glfwPostEmptyEvent). Must return at once, and not call the worker.
    using Notify = std::function<void()>;

    // With `copies`, pictures have their pixels in the CPU's memory too: for a context that shares
    // nothing with the one in which they are shown.
    Worker(MakeContext makeContext, Notify notify, bool copies = false);
    // Aborts what goes on, and waits for it. A file being read is read to its end first (seconds,
    // for the largest); hide the window before.
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    // Begins to open a scene; what waits or goes on for an earlier call is overtaken. Until it is
    // ready, the scene before is drawn; if it cannot be opened it stays, and status().error says
    // why. Gives the id that it will have; it is ready once opened() says so.
    SceneId open(SceneChoice choice);
    // Gives up opening. What was opened before stays.
    void abortOpening();

    // The newest wish replaces what waits; the one that is being drawn is finished, unless it still
    // compiles or lights (a step is not interrupted). A wish for a scene that is not ready waits
    // for it; for one that was replaced it is dropped. Equal to the last, nothing happens.
    void want(Wanted wanted);
    // The pixel to probe, of every picture from now on; nothing: none.
    void probe(std::optional<std::array<int, 2>> pixel);
    // Calls `taken` once, on the drawing thread, with the visibility of each pane of the newest
    // picture (1 channel, rows from the top) as soon as what is wanted by now has been drawn; then
    // notifies. Where there is no picture, with none. It must not call the worker.
    void capture(std::function<void(std::vector<Image>)> taken);

    std::shared_ptr<const Opened> opened() const; // the newest that is ready; null before
    std::shared_ptr<const Drawn> newest() const;  // null before the first
    std::optional<Probed> probed() const; // of the newest picture; none while it is not known
    Status status() const;

    // Waits until everything that was asked for is drawn, and references have at least so many rays
    // where one is wanted (0: whatever there is) and are judged; or something went wrong; or so
    // many seconds have passed (false). For tests, and for pictures made without a person. Not in a
    // thread that draws for a person.
    bool waitUntilDrawn(double seconds, int rays = 0);

  private:
    std::unique_ptr<WorkerState> state_;
};

} // namespace obscura
