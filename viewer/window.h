#pragma once

#include "gl/input.h"
#include "gl/library.h"
#include "image/image.h"
#include "viewer/style.h"

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace obscura {

struct KeyPress {
    gl::Key key{};
    bool shift = false, control = false;
};

// The viewer's window, its OpenGL context and its Dear ImGui. Draws when told to, and sleeps in
// between. One at a time, on the main thread.
class ViewerWindow {
  public:
    // `uiScale` 0 takes that of the screen. An Error where there is no screen, or no OpenGL 4.5.
    ViewerWindow(int width, int height, double uiScale);
    ~ViewerWindow();
    ViewerWindow(const ViewerWindow&) = delete;
    ViewerWindow& operator=(const ViewerWindow&) = delete;

    // For Worker: makes a context current on the thread that calls it. It shares this one's objects
    // but on software drivers: there one queue serves all contexts that share, and the window would
    // wait as long as a pass takes.
    std::function<std::shared_ptr<void>()> workerContext();
    bool sharesWithWorker() const { return shares_; }
    static void wake(); // ends wait(); from any thread

    bool closing() const; // the user wants it to end
    void close();
    // Sleeps until something happens, at most so many seconds (infinite: for ever).
    void wait(double seconds);
    double now() const; // seconds, steady

    const Theme& theme() const { return theme_; }
    int width() const { return width_; } // pixels of the framebuffer
    int height() const { return height_; }

    // Between the two, ImGui's calls make the picture. end() shows it. The longest time from the
    // one to the end of the other, in seconds, leaving out the first few, which make fonts.
    void begin();
    void end();
    double longestFrame() const { return longest_; }
    Image8 picture() const;             // what was drawn last, RGB; call it from afterDrawing alone
    std::function<void()> afterDrawing; // called by end() before the picture is shown

    // What has happened since the last call.
    std::vector<KeyPress> takePresses();
    std::vector<std::filesystem::path> takeDropped();

    bool isDown(gl::Key key) const;
    bool shiftIsDown() const;
    bool controlIsDown() const;
    // A locked cursor is hidden, and moves without end.
    void lockCursor(bool locked);
    bool cursorLocked() const { return locked_; }
    std::array<double, 2> takeMotion(); // of the cursor, pixels since the last call
    void setTitle(const std::string& title);
    void copyText(const std::string& text);

  private:
    void listen();
    void startImGui();
    void adoptScale();

    gl::Library library_{"; obscura-view --test needs none"};
    gl::WindowHandle window_, hidden_;
    Theme theme_;
    double uiScale_;
    int width_ = 0, height_ = 0;
    bool locked_ = false, shares_ = true;
    std::array<double, 2> cursor_{}, motion_{};
    std::vector<KeyPress> presses_;
    std::vector<std::filesystem::path> dropped_;
    double began_ = 0, longest_ = 0;
    int frames_ = 0;
};

} // namespace obscura
