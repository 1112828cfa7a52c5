#pragma once

#include "gl/window.h"
#include "image/image.h"

#include <string>
#include <vector>

namespace obscura {

// A window in which the experimenter measures the screen, outside all sessions: shows a few
// pictures, again when they were covered, and hands on what is pressed. The window's title says
// what is on view.
class Easel {
  public:
    struct Drawing {
        Image8 image;
        int x = 0, y = 0; // of its top left corner, from that of the window
    };

    explicit Easel(const gl::WindowOptions& options) : window_(options) {}

    int width() const { return window_.width(); }
    int height() const { return window_.height(); }
    const gl::Monitor& monitor() const { return window_.monitor(); }

    void show(const std::vector<Drawing>& drawings, int grey, const std::string& title);
    // Sleeps until there is a press, a letter, a click or a drag; closing the window is Escape.
    std::vector<gl::Input> inputs();

  private:
    struct Hung {
        gl::Picture picture;
        int x, y;
    };
    void redraw();

    gl::Window window_;
    std::vector<Hung> hung_;
    int grey_ = 128;
};

} // namespace obscura
