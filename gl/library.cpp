#include "gl/library.h"

#include "base/error.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace obscura::gl {

Library::Library(const std::string& advice) {
    if (!glfwInit())
        throw Error(fmt::format("no screen to open a window on ({}); is DISPLAY or "
                                "WAYLAND_DISPLAY set?{}",
                                problem(), advice));
}

Library::~Library() { glfwTerminate(); }

std::string Library::problem() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

void DestroyWindow::operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }

} // namespace obscura::gl
