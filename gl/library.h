#pragma once

#include <memory>
#include <string>

struct GLFWwindow;

namespace obscura::gl {

// GLFW itself, for as long as a window of it lives. An Error where there is no screen; `advice`
// says what can be done without one.
class Library {
  public:
    explicit Library(const std::string& advice = "");
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    static std::string problem(); // GLFW's word for what went wrong last
};

struct DestroyWindow {
    void operator()(GLFWwindow* window) const;
};
using WindowHandle = std::unique_ptr<GLFWwindow, DestroyWindow>;

} // namespace obscura::gl
