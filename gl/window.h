#pragma once

#include "gl/context.h"
#include "gl/input.h"
#include "gl/picture.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace obscura::gl {

struct Monitor {
    std::string name;
    int width = 0, height = 0, refreshHz = 0; // of its current mode, as the system reports it
    int widthMm = 0, heightMm = 0;
    int x = 0, y = 0; // on the desktop
};

// Those connected, the primary one first. Not to be called while a Window lives.
std::vector<Monitor> monitors();

struct WindowOptions {
    struct Size {
        int width, height;
    };
    std::string title;
    int monitor = 1;              // from 1, as monitors() lists them
    std::optional<Size> windowed; // nothing: full screen, in the monitor's current mode
    // Called by poll(), swap() and, several times a second, wait(): may throw to end what goes on.
    void (*interrupt)() = [] {};
};

// A window with an OpenGL 4.5 context for showing pictures pixel by pixel: double-buffered,
// synchronised to the vertical blank where the driver can, its framebuffer 8 bits and not sRGB.
// Input is collected with the time at which it arrived.
class Window {
  public:
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    int width() const { return width_; } // of the framebuffer
    int height() const { return height_; }
    double contentScale() const;
    const Monitor& monitor() const { return monitor_; }
    Driver driver() const { return currentDriver(); }

    double now() const; // seconds since the window was made, steady

    // Fills the back buffer with a code value, 0 ... 255.
    void clear(int grey);
    // Copies the picture to the back buffer, its top left corner at (x, y) from that of the buffer.
    void draw(const Picture& picture, int x, int y);
    // Waits until all drawing is done.
    void finish();
    // Raises as an Error what the driver has complained of since the window was made.
    void check() { throwMessages(); }
    // Puts the back buffer on screen. Returns when the driver has done so, as far as it tells:
    // with a vertical blank, after it.
    void swap();

    std::vector<Input> poll(); // what has arrived, without waiting
    std::vector<Input> wait(); // sleeps until something arrives
    void showCursor(bool visible);
    bool focused() const; // whether the keyboard is ours
    void setTitle(const std::string& title);

  private:
    // GLFW itself, for as long as its window lives.
    struct Library {
        Library();
        ~Library();
        Library(const Library&) = delete;
        Library& operator=(const Library&) = delete;
    };
    struct Destroy {
        void operator()(GLFWwindow* window) const;
    };
    friend std::vector<Monitor> monitors();

    void open(const WindowOptions& options);
    void listen();
    Input stamped(Input::Kind kind) const;

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    Library library_;
    Monitor monitor_;
    std::unique_ptr<GLFWwindow, Destroy> window_;
    int width_ = 0, height_ = 0;
    std::vector<Input> inputs_;
    void (*interrupt_)();
};

} // namespace obscura::gl
