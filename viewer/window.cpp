#include "viewer/window.h"

#include "base/error.h"
#include "gl/context.h"
#include "gl/screen.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace obscura {

namespace {

void hintContext() {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

ViewerWindow& self(GLFWwindow* window) {
    return *static_cast<ViewerWindow*>(glfwGetWindowUserPointer(window));
}

} // namespace

ViewerWindow::ViewerWindow(int width, int height, double uiScale) : uiScale_(uiScale) {
    hintContext();
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, uiScale == 0 ? GLFW_TRUE : GLFW_FALSE);
    window_.reset(glfwCreateWindow(width, height, "Obscura", nullptr, nullptr));
    if (!window_)
        throw Error(fmt::format("expected a window with OpenGL 4.5, found none: {}",
                                gl::Library::problem()));
    glfwMakeContextCurrent(window_.get());
    gl::collectMessages();
    shares_ = !gl::currentDriver().software;
    if (shares_) {
        hintContext();
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        hidden_.reset(glfwCreateWindow(16, 16, "", nullptr, window_.get()));
        if (!hidden_)
            throw Error(fmt::format("expected a second OpenGL context that shares objects with the "
                                    "window's, found none: {}",
                                    gl::Library::problem()));
    }
    glfwSetWindowSizeLimits(window_.get(), 640, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwSwapInterval(1);
    glfwFocusWindow(window_.get());
    listen();
    startImGui();
}

ViewerWindow::~ViewerWindow() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

std::function<std::shared_ptr<void>()> ViewerWindow::workerContext() {
    if (!shares_)
        return [] { return std::make_shared<gl::Context>(); };
    return [window = hidden_.get()] {
        glfwMakeContextCurrent(window);
        gl::collectMessages();
        return std::shared_ptr<void>(window, [](void*) { glfwMakeContextCurrent(nullptr); });
    };
}

void ViewerWindow::wake() { glfwPostEmptyEvent(); }

// ImGui installs its own callbacks later, and calls these.
void ViewerWindow::listen() {
    glfwSetWindowUserPointer(window_.get(), this);
    glfwGetCursorPos(window_.get(), &cursor_[0], &cursor_[1]);
    glfwSetKeyCallback(window_.get(), [](GLFWwindow* window, int key, int, int action, int mods) {
        if (action == GLFW_PRESS)
            self(window).presses_.push_back({static_cast<gl::Key>(key),
                                             (mods & GLFW_MOD_SHIFT) != 0,
                                             (mods & GLFW_MOD_CONTROL) != 0});
    });
    glfwSetDropCallback(window_.get(), [](GLFWwindow* window, int count, const char** paths) {
        for (int i = 0; i < count; ++i)
            self(window).dropped_.emplace_back(paths[i]);
    });
    glfwSetCursorPosCallback(window_.get(), [](GLFWwindow* window, double x, double y) {
        ViewerWindow& w = self(window);
        w.motion_[0] += x - w.cursor_[0];
        w.motion_[1] += y - w.cursor_[1];
        w.cursor_ = {x, y};
    });
}

void ViewerWindow::startImGui() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    ImGui_ImplGlfw_InitForOpenGL(window_.get(), true);
    ImGui_ImplOpenGL3_Init("#version 450");
    adoptScale();
}

// Fonts are made anew where the window has come to a screen of another scale.
void ViewerWindow::adoptScale() {
    float scale = static_cast<float>(uiScale_);
    if (scale == 0)
        glfwGetWindowContentScale(window_.get(), &scale, nullptr);
    scale = std::clamp(scale, 0.75F, 4.0F);
    if (scale == theme_.scale && theme_.text)
        return;
    if (theme_.text)
        ImGui_ImplOpenGL3_DestroyFontsTexture();
    theme_ = makeTheme(scale);
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

bool ViewerWindow::closing() const { return glfwWindowShouldClose(window_.get()); }
void ViewerWindow::close() { glfwSetWindowShouldClose(window_.get(), GLFW_TRUE); }

void ViewerWindow::wait(double seconds) {
    if (seconds <= 0)
        glfwPollEvents();
    else if (std::isfinite(seconds))
        glfwWaitEventsTimeout(seconds);
    else
        glfwWaitEvents();
}

double ViewerWindow::now() const { return glfwGetTime(); }

void ViewerWindow::begin() {
    began_ = now();
    glfwGetFramebufferSize(window_.get(), &width_, &height_);
    adoptScale();
    ImGuiIO& io = ImGui::GetIO();
    if (locked_)
        io.ConfigFlags |= ImGuiConfigFlags_NoMouse;
    else
        io.ConfigFlags &= ~ImGuiConfigFlags_NoMouse;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void ViewerWindow::end() {
    ImGui::Render();
    const ImVec4 backdrop = ImGui::ColorConvertU32ToFloat4(colours::backdrop);
    gl::clearScreen(width_, height_, {backdrop.x, backdrop.y, backdrop.z});
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    if (afterDrawing)
        afterDrawing();
    glfwSwapBuffers(window_.get());
    gl::throwMessages();
    constexpr int warmUp = 3;
    if (++frames_ > warmUp)
        longest_ = std::max(longest_, now() - began_);
}

Image8 ViewerWindow::picture() const {
    const std::vector<std::uint8_t> rows = gl::readScreen(width_, height_);
    Image8 image{width_, height_, 3, {}};
    const auto row = static_cast<std::ptrdiff_t>(3) * width_;
    for (std::ptrdiff_t y = height_ - 1; y >= 0; --y)
        image.pixels.insert(image.pixels.end(), rows.begin() + y * row,
                            rows.begin() + (y + 1) * row);
    return image;
}

std::vector<KeyPress> ViewerWindow::takePresses() { return std::exchange(presses_, {}); }

std::vector<std::filesystem::path> ViewerWindow::takeDropped() {
    return std::exchange(dropped_, {});
}

bool ViewerWindow::isDown(gl::Key key) const {
    return glfwGetKey(window_.get(), static_cast<int>(key)) == GLFW_PRESS;
}

bool ViewerWindow::shiftIsDown() const {
    return glfwGetKey(window_.get(), GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
           glfwGetKey(window_.get(), GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
}

bool ViewerWindow::controlIsDown() const {
    return glfwGetKey(window_.get(), GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
           glfwGetKey(window_.get(), GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
}

void ViewerWindow::lockCursor(bool locked) {
    if (locked == locked_)
        return;
    locked_ = locked;
    glfwSetInputMode(window_.get(), GLFW_CURSOR,
                     locked ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    glfwGetCursorPos(window_.get(), &cursor_[0], &cursor_[1]);
    motion_ = {};
}

std::array<double, 2> ViewerWindow::takeMotion() { return std::exchange(motion_, {}); }

void ViewerWindow::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_.get(), title.c_str());
}

void ViewerWindow::copyText(const std::string& text) {
    glfwSetClipboardString(window_.get(), text.c_str());
}

} // namespace obscura
