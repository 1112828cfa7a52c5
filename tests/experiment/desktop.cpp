#include "tests/experiment/desktop.h"

#include "base/error.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <X11/extensions/Xrandr.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace obscura::test {

struct Desktop::Connection {
    explicit Connection(const std::string& name) : display(XOpenDisplay(name.c_str())) {}
    ~Connection() {
        if (display)
            XCloseDisplay(display);
    }
    Display* display;
};

Desktop::Desktop(int width, int height, int bitsPerPixel) : width_(width), height_(height) {
    // A window may be gone between being listed and being asked; Xlib would end the test program.
    XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
    start(bitsPerPixel);
    connection_ = std::make_unique<Connection>(name_);
    if (!connection_->display)
        throw Error("Xvfb runs, but refuses connections on " + name_);
}

Desktop::~Desktop() {
    connection_.reset();
    if (server_ > 0) {
        ::kill(server_, SIGTERM);
        ::waitpid(server_, nullptr, 0);
    }
}

// The server picks a free number and writes it, and a line feed, once it is ready.
void Desktop::start(int bitsPerPixel) {
    int channel[2];
    if (::pipe(channel) != 0)
        throw Error("no pipe");
    const std::string screen = fmt::format("{}x{}x{}", width_, height_, bitsPerPixel);
    const std::string descriptor = fmt::format("{}", channel[1]);
    server_ = ::fork();
    if (server_ == 0) {
        ::close(channel[0]);
        const int silence = ::open("/dev/null", O_WRONLY);
        ::dup2(silence, STDERR_FILENO);
        ::execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", screen.c_str(),
                 "-nolisten", "tcp", "-noreset", nullptr);
        ::_exit(127);
    }
    ::close(channel[1]);
    std::string number;
    for (char c; ::read(channel[0], &c, 1) == 1 && c != '\n';)
        number += c;
    ::close(channel[0]);
    if (number.empty())
        throw Error("Xvfb does not start; the presenter's tests need it: apt install xvfb");
    name_ = ":" + number;
}

void Desktop::press(unsigned long keySymbol) {
    XTestFakeKeyEvent(connection_->display, XKeysymToKeycode(connection_->display, keySymbol), True,
                      CurrentTime);
    XSync(connection_->display, False);
}

void Desktop::release(unsigned long keySymbol) {
    XTestFakeKeyEvent(connection_->display, XKeysymToKeycode(connection_->display, keySymbol),
                      False, CurrentTime);
    XSync(connection_->display, False);
}

// The server stamps in milliseconds, and GLFW takes a second press of the same stamp for an echo.
void Desktop::tap(unsigned long keySymbol) {
    press(keySymbol);
    release(keySymbol);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

void Desktop::type(const std::string& lettersAndDigits) {
    for (const char c : lettersAndDigits)
        tap(static_cast<unsigned long>(c));
}

void Desktop::click(int x, int y) {
    XTestFakeMotionEvent(connection_->display, 0, x, y, CurrentTime);
    XTestFakeButtonEvent(connection_->display, 1, True, CurrentTime);
    XTestFakeButtonEvent(connection_->display, 1, False, CurrentTime);
    XSync(connection_->display, False);
}

void Desktop::takeFocus() {
    int revertTo = 0;
    XGetInputFocus(connection_->display, &focused_, &revertTo);
    XSetInputFocus(connection_->display, None, RevertToNone, CurrentTime);
    XSync(connection_->display, False);
}

void Desktop::returnFocus() {
    XSetInputFocus(connection_->display, focused_, RevertToNone, CurrentTime);
    XSync(connection_->display, False);
}

void Desktop::scaleTo(int percent) {
    Display* display = connection_->display;
    const std::string resources = fmt::format("Xft.dpi:\t{}\n", 96 * percent / 100);
    XChangeProperty(display, DefaultRootWindow(display), XA_RESOURCE_MANAGER, XA_STRING, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(resources.data()),
                    static_cast<int>(resources.size()));
    XSync(display, False);
}

void Desktop::unplug() {
    Display* display = connection_->display;
    const Window root = DefaultRootWindow(display);
    XRRScreenResources* screen = XRRGetScreenResourcesCurrent(display, root);
    for (int i = 0; i < screen->ncrtc; ++i)
        XRRSetCrtcConfig(display, screen, screen->crtcs[i], CurrentTime, 0, 0, None, RR_Rotate_0,
                         nullptr, 0);
    XRRFreeScreenResources(screen);
    XSync(display, False);
}

void Desktop::startCompositor() {
    Display* display = connection_->display;
    const Window owner =
        XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(display, XInternAtom(display, "_NET_WM_CM_S0", False), owner, CurrentTime);
    XSync(display, False);
}

Image8 Desktop::look() const {
    Display* display = connection_->display;
    XImage* grab =
        XGetImage(display, DefaultRootWindow(display), 0, 0, static_cast<unsigned>(width_),
                  static_cast<unsigned>(height_), AllPlanes, ZPixmap);
    Image8 image{width_, height_, 3, {}};
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
            for (const int shift : {16, 8, 0})
                image.pixels.push_back(static_cast<std::uint8_t>(XGetPixel(grab, x, y) >> shift));
    XDestroyImage(grab);
    return image;
}

std::string Desktop::title() const {
    Display* display = connection_->display;
    Window root = 0, parent = 0, *children = nullptr;
    unsigned count = 0;
    if (!XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count))
        return "";
    std::string found;
    for (unsigned i = 0; i < count; ++i)
        if (char* name = nullptr; XFetchName(display, children[i], &name) && name) {
            if (const std::string text = name; text.starts_with("Obscura"))
                found = text;
            XFree(name);
        }
    XFree(children);
    return found;
}

bool Desktop::hasKeyboard() const {
    Window window = 0;
    int revertTo = 0;
    XGetInputFocus(connection_->display, &window, &revertTo);
    return window != None && window != PointerRoot;
}

} // namespace obscura::test
