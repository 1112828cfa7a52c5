#pragma once

#include "experiment/refresh.h"
#include "gl/window.h"
#include "image/image.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <span>

namespace obscura {

// What the screen shows first: a picture for a screen of that width and height.
using Curtain = std::function<Image8(int, int)>;

// A picture and where its top left corner goes, from the top left of the screen.
struct Placed {
    const gl::Picture* picture = nullptr;
    int x = 0, y = 0;
};

// The screen: shows one picture at a time, 1:1 in its middle on the surround grey, and says when it
// came on. Its rate is measured when it is made, with `curtain` on view. Where swaps follow no
// vertical blank (Xvfb, a driver told not to wait) it is paced by the clock at 60 Hz, and refresh()
// says so.
class Display {
  public:
    Display(const gl::WindowOptions& options, int grey, const Curtain& curtain);

    const Refresh& refresh() const { return refresh_; }
    void describe(nlohmann::ordered_json& sidecar) const;
    gl::Window& window() { return window_; }

    // Draws without showing, so that the first showing is not slower than others. An Error when
    // the picture is larger than the screen: nothing is ever scaled.
    void warmUp(const gl::Picture& picture);

    // Shows the picture, or grey alone without one, and returns the time at which it came on.
    double show(const gl::Picture* picture);
    // The same with several, each with its top left corner at a place, on another grey.
    double show(std::span<const Placed> pictures, int grey);

  private:
    void measure(const gl::Picture& curtain);
    void draw(std::span<const Placed> pictures, int grey);
    Placed centred(const gl::Picture& picture) const;
    void awaitTick();

    gl::Window window_;
    int grey_;
    bool windowed_;
    Refresh refresh_;
    bool paced_ = false;
};

} // namespace obscura
