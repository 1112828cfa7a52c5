#include "gl/window.h"

#include "base/error.h"
#include "gl/x11.h"

#include <epoxy/gl.h>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace obscura::gl {

static_assert(static_cast<int>(Key::space) == GLFW_KEY_SPACE);
static_assert(static_cast<int>(Key::one) == GLFW_KEY_1);
static_assert(static_cast<int>(Key::two) == GLFW_KEY_2);
static_assert(static_cast<int>(Key::escape) == GLFW_KEY_ESCAPE);
static_assert(static_cast<int>(Key::enter) == GLFW_KEY_ENTER);
static_assert(static_cast<int>(Key::backspace) == GLFW_KEY_BACKSPACE);
static_assert(static_cast<int>(Key::right) == GLFW_KEY_RIGHT);
static_assert(static_cast<int>(Key::left) == GLFW_KEY_LEFT);
static_assert(static_cast<int>(Key::keypadOne) == GLFW_KEY_KP_1);
static_assert(static_cast<int>(Key::keypadTwo) == GLFW_KEY_KP_2);
static_assert(static_cast<int>(Key::zero) == GLFW_KEY_0);
static_assert(static_cast<int>(Key::nine) == GLFW_KEY_9);
static_assert(static_cast<int>(Key::tab) == GLFW_KEY_TAB);
static_assert(static_cast<int>(Key::down) == GLFW_KEY_DOWN);
static_assert(static_cast<int>(Key::up) == GLFW_KEY_UP);
static_assert(static_cast<int>(Key::keypadZero) == GLFW_KEY_KP_0);
static_assert(static_cast<int>(Key::keypadNine) == GLFW_KEY_KP_9);
static_assert(static_cast<int>(Key::keypadEnter) == GLFW_KEY_KP_ENTER);
static_assert(static_cast<int>(Key::leftBracket) == GLFW_KEY_LEFT_BRACKET);
static_assert(static_cast<int>(Key::rightBracket) == GLFW_KEY_RIGHT_BRACKET);
static_assert(static_cast<int>(Key::f1) == GLFW_KEY_F1);
static_assert(static_cast<int>(Key::f12) == GLFW_KEY_F12);
static_assert(static_cast<int>(Key::leftShift) == GLFW_KEY_LEFT_SHIFT);
static_assert(static_cast<int>(Key::leftControl) == GLFW_KEY_LEFT_CONTROL);

namespace {

Monitor describe(GLFWmonitor* handle) {
    Monitor monitor;
    const GLFWvidmode* mode = glfwGetVideoMode(handle);
    monitor.name = glfwGetMonitorName(handle);
    monitor.width = mode->width;
    monitor.height = mode->height;
    monitor.refreshHz = mode->refreshRate;
    glfwGetMonitorPhysicalSize(handle, &monitor.widthMm, &monitor.heightMm);
    glfwGetMonitorPos(handle, &monitor.x, &monitor.y);
    return monitor;
}

GLFWmonitor* chosenMonitor(int number) {
    int count = 0;
    GLFWmonitor** handles = glfwGetMonitors(&count);
    if (number < 1 || number > count)
        throw Error(fmt::format("there is no monitor {}: {} connected; --list-monitors names them",
                                number, count == 1 ? "one is" : fmt::format("{} are", count)));
    return handles[number - 1];
}

void hintContext() {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

// A full-screen window keeps the screen when the focus goes elsewhere: a second monitor may be in
// use by the experimenter. The mode is never changed.
void hintWindow(const GLFWvidmode& mode) {
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfwWindowHint(GLFW_RED_BITS, mode.redBits);
    glfwWindowHint(GLFW_GREEN_BITS, mode.greenBits);
    glfwWindowHint(GLFW_BLUE_BITS, mode.blueBits);
    glfwWindowHint(GLFW_REFRESH_RATE, mode.refreshRate);
}

} // namespace

std::vector<Monitor> monitors() {
    const Library library;
    int count = 0;
    GLFWmonitor** handles = glfwGetMonitors(&count);
    std::vector<Monitor> result;
    for (int i = 0; i < count; ++i)
        result.push_back(describe(handles[i]));
    return result;
}

Window::Window(const WindowOptions& options) : interrupt_(options.interrupt) {
    constexpr std::size_t expected = 256; // inputs between two calls of poll()
    inputs_.reserve(expected);
    taken_.reserve(expected);
    open(options);
    listen();
    glfwMakeContextCurrent(window_.get());
    collectMessages();
    glfwSwapInterval(1);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DITHER);
    glfwFocusWindow(window_.get());
    glfwPollEvents(); // the system may still resize it
    take();
    glfwGetFramebufferSize(window_.get(), &width_, &height_);
    glViewport(0, 0, width_, height_);
    lost_.clear();
}

Window::~Window() { glfwSetMonitorCallback(nullptr); }

void Window::open(const WindowOptions& options) {
    GLFWmonitor* handle = chosenMonitor(options.monitor);
    screen_ = handle;
    monitor_ = describe(handle);
    hintContext();
    hintWindow(*glfwGetVideoMode(handle));
    const WindowOptions::Size size =
        options.windowed.value_or(WindowOptions::Size{monitor_.width, monitor_.height});
    window_.reset(glfwCreateWindow(size.width, size.height, options.title.c_str(),
                                   options.windowed ? nullptr : handle, nullptr));
    if (!window_)
        throw Error(fmt::format("expected a window with OpenGL 4.5 on monitor {} ({}): {}",
                                options.monitor, monitor_.name, Library::problem()));
    if (options.windowed)
        glfwSetWindowPos(window_.get(), monitor_.x + (monitor_.width - size.width) / 2,
                         monitor_.y + (monitor_.height - size.height) / 2);
}

// GLFW's callbacks are C: they only note what happened.
void Window::listen() {
    static const auto self = [](GLFWwindow* window) -> Window& {
        return *static_cast<Window*>(glfwGetWindowUserPointer(window));
    };
    glfwSetWindowUserPointer(window_.get(), this);
    glfwSetKeyCallback(window_.get(), [](GLFWwindow* window, int key, int, int action, int) {
        if (action == GLFW_REPEAT)
            return;
        Input input =
            self(window).stamped(action == GLFW_PRESS ? Input::Kind::press : Input::Kind::release);
        input.key = static_cast<Key>(key);
        self(window).inputs_.push_back(input);
    });
    glfwSetCharCallback(window_.get(), [](GLFWwindow* window, unsigned symbol) {
        Input input = self(window).stamped(Input::Kind::text);
        input.symbol = symbol;
        self(window).inputs_.push_back(input);
    });
    glfwSetMouseButtonCallback(window_.get(), [](GLFWwindow* window, int button, int action, int) {
        if (button != GLFW_MOUSE_BUTTON_LEFT || action != GLFW_PRESS)
            return;
        self(window).inputs_.push_back(self(window).stampedAtCursor(Input::Kind::click));
    });
    glfwSetCursorPosCallback(window_.get(), [](GLFWwindow* window, double, double) {
        if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
            self(window).inputs_.push_back(self(window).stampedAtCursor(Input::Kind::drag));
    });
    glfwSetWindowFocusCallback(window_.get(), [](GLFWwindow* window, int focused) {
        self(window).inputs_.push_back(
            self(window).stamped(focused ? Input::Kind::focusGained : Input::Kind::focusLost));
    });
    glfwSetWindowRefreshCallback(window_.get(), [](GLFWwindow* window) {
        self(window).inputs_.push_back(self(window).stamped(Input::Kind::exposed));
    });
    glfwSetFramebufferSizeCallback(window_.get(), [](GLFWwindow* window, int width, int height) {
        self(window).lost_ = fmt::format("the screen's size changed from {}x{} to {}x{} pixels",
                                         self(window).width_, self(window).height_, width, height);
    });
    // Of all monitors, without a window to tell; there is one window at a time.
    static GLFWwindow* listening = nullptr;
    listening = window_.get();
    glfwSetMonitorCallback([](GLFWmonitor* monitor, int event) {
        Window& window = self(listening);
        if (event == GLFW_DISCONNECTED && monitor == window.screen_)
            window.lost_ = "the monitor " + window.monitor_.name + " was disconnected";
    });
    glfwSetWindowCloseCallback(window_.get(), [](GLFWwindow* window) {
        glfwSetWindowShouldClose(window, GLFW_FALSE);
        self(window).inputs_.push_back(self(window).stamped(Input::Kind::close));
    });
}

void Window::checkScreen() {
    if (!lost_.empty())
        throw Error(lost_);
    if (sleep_.slept())
        inputs_.push_back(stamped(Input::Kind::focusLost));
}

Input Window::stamped(Input::Kind kind) const {
    Input input;
    input.kind = kind;
    input.time = now();
    return input;
}

Input Window::stampedAtCursor(Input::Kind kind) const {
    double x = 0, y = 0;
    glfwGetCursorPos(window_.get(), &x, &y);
    int width = 1, height = 1;
    glfwGetWindowSize(window_.get(), &width, &height);
    Input input = stamped(kind);
    input.x = static_cast<int>(x * width_ / width);
    input.y = static_cast<int>(y * height_ / height);
    return input;
}

double Window::contentScale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_.get(), &x, &y);
    return static_cast<double>(x);
}

std::array<int, 3> Window::colourBits() const {
    std::array<int, 3> bits{};
    glGetNamedFramebufferAttachmentParameteriv(0, GL_BACK_LEFT, GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE,
                                               &bits[0]);
    glGetNamedFramebufferAttachmentParameteriv(0, GL_BACK_LEFT,
                                               GL_FRAMEBUFFER_ATTACHMENT_GREEN_SIZE, &bits[1]);
    glGetNamedFramebufferAttachmentParameteriv(0, GL_BACK_LEFT, GL_FRAMEBUFFER_ATTACHMENT_BLUE_SIZE,
                                               &bits[2]);
    return bits;
}

std::optional<bool> Window::composited() const { return compositorRuns(); }

std::optional<bool> Window::forbidVariableRefresh() {
    return gl::forbidVariableRefresh(window_.get());
}

double Window::now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Window::clear(int grey) {
    const float value = static_cast<float>(grey) / 255.0f;
    glClearColor(value, value, value, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

void Window::draw(const Picture& picture, int x, int y) { picture.draw(x, y, height_); }

void Window::fillCorner(int size, int grey) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, size, size);
    clear(grey);
    glDisable(GL_SCISSOR_TEST);
}

void Window::finish() { glFinish(); }

bool Window::countsBlanks() const { return gl::countsBlanks(); }

Onset Window::swap() {
    glfwSwapBuffers(window_.get());
    const Onset onset = awaitOnset();
    interrupt_();
    checkScreen();
    return onset;
}

// Some drivers return from the swap at once and wait in the next drawing call instead
// (glfw/glfw#1672): touching one pixel of the new back buffer brings the wait here. It is
// overdrawn by the next clear().
Onset Window::awaitOnset() const {
    if (stamp_ == Stamp::blanks) {
        const double start = std::chrono::duration<double>(start_.time_since_epoch()).count();
        if (const auto blank = awaitBlank())
            return {blank->time - start, blank->count};
    } else if (stamp_ == Stamp::finish) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, 1, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        glDisable(GL_SCISSOR_TEST);
        glFinish();
    }
    return {now()};
}

const std::vector<Input>& Window::poll() {
    glfwPollEvents();
    gamepads_.look(now(), inputs_);
    interrupt_();
    checkScreen();
    return take();
}

const std::vector<Input>& Window::wait(double atMost) {
    constexpr double interval = 0.1, least = 1e-4; // seconds between calls of interrupt_
    constexpr double look = 0.001;                 // and at a gamepad
    const double end = now() + atMost;
    gamepads_.look(now(), inputs_);
    for (interrupt_(); inputs_.empty() && now() < end; interrupt_()) {
        const double pause = gamepads_.present() ? look : interval;
        glfwWaitEventsTimeout(std::clamp(end - now(), least, pause));
        gamepads_.look(now(), inputs_);
        checkScreen();
    }
    return take();
}

// The memory of both lists is used again.
const std::vector<Input>& Window::take() {
    taken_.clear();
    std::swap(inputs_, taken_);
    return taken_;
}

void Window::showCursor(bool visible) {
    glfwSetInputMode(window_.get(), GLFW_CURSOR, visible ? GLFW_CURSOR_NORMAL : GLFW_CURSOR_HIDDEN);
}

bool Window::focused() const {
    return glfwGetWindowAttrib(window_.get(), GLFW_FOCUSED) == GLFW_TRUE;
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_.get(), title.c_str());
}

} // namespace obscura::gl
