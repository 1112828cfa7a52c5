#pragma once

#include "experiment/refresh.h"
#include "experiment/timing_check.h"
#include "experiment/timing_priority.h"
#include "experiment/timing_ticks.h"
#include "experiment/trigger.h"
#include "gl/window.h"
#include "image/image.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// What the screen shows first: a picture for a screen of that width and height.
using Curtain = std::function<Image8(int, int)>;

// A picture and where its top left corner goes, from the top left of the screen.
struct Placed {
    const gl::Picture* picture = nullptr;
    int x = 0, y = 0;
};

struct DisplayOptions {
    gl::WindowOptions window;
    int grey = 128;          // of the surround, a code value
    bool photodiode = false; // a square in the lower left corner, white while a stimulus is on view
                             // and black otherwise, for a light sensor
    std::string trigger = {}; // who is told of each onset, as openTrigger() takes it; "": nobody
};

// The screen: shows one picture at a time, 1:1 in its middle on the surround grey, and says when it
// came on. When it is made, it is checked with `curtain` on view: how fast it is, and whether that
// can be relied on. Where swaps follow no vertical blank (Xvfb, a driver told not to wait) it is
// paced by the clock at 60 Hz, and refresh() says so.
class StimulusDisplay {
  public:
    StimulusDisplay(const DisplayOptions& options, const Curtain& curtain);

    const Refresh& refresh() const { return refresh_; }
    // Why no data should be collected on it, and what to do; "" if they may.
    std::string objection() const { return objectionTo(check_); }
    // What the check found, in a line.
    std::string inWords() const;
    void describe(nlohmann::ordered_json& sidecar) const;
    // Tells the trigger's receiver that the phase came on at `onset`; both are counted from 1.
    void mark(double onset, int trial, int phase, std::string_view name);
    // From now on marks are counted anew; and how it went with those so far.
    void countMarks();
    void describeMarks(nlohmann::ordered_json& sidecar) const;
    gl::Window& window() { return window_; }
    const gl::Monitor& monitor() const { return window_.monitor(); }

    // Draws without showing, so that the first showing is not slower than others. An Error when
    // the picture is larger than the screen: nothing is ever scaled.
    void warmUp(const gl::Picture& picture);

    // Shows the picture, or grey alone without one, and returns the time at which it came on.
    double show(const gl::Picture* picture, bool stimulus = false);
    // The same with several, each with its top left corner at a place, on another grey.
    double show(std::span<const Placed> pictures, int grey, bool stimulus = false);

  private:
    void measure(const gl::Picture& curtain);
    bool measureBy(gl::Window::Stamp stamp, const gl::Picture& curtain);
    void check(const gl::Picture& curtain);
    std::vector<double> burst(const gl::Picture& curtain);
    void draw(std::span<const Placed> pictures, int grey, bool stimulus);
    Placed centred(const gl::Picture& picture) const;

    std::string receiver_;
    std::unique_ptr<Trigger> trigger_; // opened first: without its receiver nothing begins
    Priority priority_; // asked for before the window is made, for the driver's threads inherit it
    gl::Window window_;
    int grey_;
    bool photodiode_;
    bool windowed_;
    DisplayCheck check_;
    Refresh refresh_;
    std::optional<Ticks> ticks_; // in place of vertical blanks
};

} // namespace obscura
