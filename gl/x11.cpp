#include "gl/x11.h"

#include <epoxy/glx.h>

#include <GLFW/glfw3.h>
#include <X11/Xatom.h>
#include <fmt/format.h>

// As in GLFW/glfw3native.h, which would want the headers of XRandR, too.
extern "C" GLFWAPI Window glfwGetX11Window(GLFWwindow* window);

namespace obscura::gl {

namespace {

// Of the property's first value; 0 where there is none.
unsigned long valueOf(Display* display, Window window, Atom property) {
    Atom type = None;
    int format = 0;
    unsigned long count = 0, left = 0, value = 0;
    unsigned char* data = nullptr;
    if (XGetWindowProperty(display, window, property, 0, 1, False, XA_CARDINAL, &type, &format,
                           &count, &left, &data) == Success &&
        count == 1 && format == 32)
        value = *reinterpret_cast<unsigned long*>(data);
    if (data)
        XFree(data);
    return value;
}

} // namespace

bool countsBlanks() {
    Display* display = glXGetCurrentDisplay();
    return display &&
           epoxy_has_glx_extension(display, DefaultScreen(display), "GLX_OML_sync_control");
}

std::optional<Blank> awaitBlank() {
    std::int64_t microseconds = 0, blanks = 0, swaps = 0;
    if (!glXWaitForSbcOML(glXGetCurrentDisplay(), glXGetCurrentDrawable(), 0, &microseconds,
                          &blanks, &swaps))
        return std::nullopt;
    return Blank{blanks, static_cast<double>(microseconds) * 1e-6};
}

std::optional<bool> compositorRuns() {
    Display* display = glXGetCurrentDisplay();
    if (!display)
        return std::nullopt;
    const std::string selection = fmt::format("_NET_WM_CM_S{}", DefaultScreen(display));
    return XGetSelectionOwner(display, XInternAtom(display, selection.c_str(), False)) != None;
}

std::optional<bool> forbidVariableRefresh(GLFWwindow* window) {
    Display* display = glXGetCurrentDisplay();
    if (!display)
        return std::nullopt;
    const Window handle = glfwGetX11Window(window);
    const Atom property = XInternAtom(display, "_VARIABLE_REFRESH", False);
    const bool asked = valueOf(display, handle, property) != 0;
    if (asked)
        XDeleteProperty(display, handle, property);
    return asked;
}

} // namespace obscura::gl
