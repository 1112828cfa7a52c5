#pragma once

#include "gl/context.h"
#include "gl/gamepad.h"
#include "gl/input.h"
#include "gl/library.h"
#include "gl/picture.h"
#include "gl/sleep_watch.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct GLFWmonitor;

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

// When a picture came on, in seconds since the window was made.
struct Onset {
    double time = 0;
    std::int64_t blanks =
        0; // vertical blanks then, as the display counts them; 0 where it does not
};

// A window with an OpenGL 4.5 context for showing pictures pixel by pixel: double-buffered,
// synchronised to the vertical blank where the driver can, its framebuffer 8 bits and not sRGB.
// Input is collected with the time at which it arrived. poll(), swap() and wait() throw an Error
// once its monitor has been disconnected, or its size has changed. After the machine was suspended,
// the keyboard counts as lost.
class Window {
  public:
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    int width() const { return width_; } // of the framebuffer
    int height() const { return height_; }
    double contentScale() const;                 // 1 is 100 %
    std::array<int, 3> colourBits() const;       // of red, green and blue
    std::optional<bool> composited() const;      // whether a compositor runs; nothing: not known
    std::optional<bool> forbidVariableRefresh(); // true when the driver had asked for it
    const Monitor& monitor() const { return monitor_; }
    Driver driver() const { return currentDriver(); }

    double now() const; // seconds since the window was made, steady

    // Fills the back buffer with a code value, 0 ... 255.
    void clear(int grey);
    // Fills a square of that many pixels in the back buffer's lower left corner.
    void fillCorner(int size, int grey);
    // Copies the picture to the back buffer, its top left corner at (x, y) from that of the buffer.
    void draw(const Picture& picture, int x, int y);
    // Waits until all drawing is done.
    void finish();
    // Raises as an Error what the driver has complained of since the window was made.
    void check() { throwMessages(); }
    // How swap() knows when a picture came on, the best first: the display's own clock of vertical
    // blanks, where countsBlanks(); when the driver says that it has finished; when it returns.
    enum class Stamp { blanks, finish, none };
    bool countsBlanks() const;
    void stampBy(Stamp stamp) { stamp_ = stamp; }
    // Puts the back buffer on screen. Returns when the driver has done so, as far as it tells:
    // with a vertical blank, after it.
    Onset swap();

    // What has arrived, without waiting or allocating; valid until the next call.
    const std::vector<Input>& poll();
    // The same, but sleeps until something arrives, or for so many seconds; where there is a
    // gamepad, which has no events, for a millisecond at a time.
    const std::vector<Input>& wait(double atMost = std::numeric_limits<double>::infinity());
    void showCursor(bool visible);
    bool focused() const; // whether the keyboard is ours
    void setTitle(const std::string& title);

  private:
    void open(const WindowOptions& options);
    void listen();
    void checkScreen();
    Input stamped(Input::Kind kind) const;
    Input stampedAtCursor(Input::Kind kind) const;
    const std::vector<Input>& take();
    Onset awaitOnset() const;

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    Library library_;
    GLFWmonitor* screen_ = nullptr;
    Monitor monitor_; // the same, described
    WindowHandle window_;
    int width_ = 0, height_ = 0;
    std::vector<Input> inputs_, taken_;
    Gamepads gamepads_;
    void (*interrupt_)();
    SleepWatch sleep_;
    std::string lost_; // why nothing can be shown any more; "" for nothing
    Stamp stamp_ = Stamp::finish;
};

} // namespace obscura::gl
