#pragma once

#include <memory>
#include <string>
#include <vector>

namespace obscura::gl {

// What the driver calls itself; part of every recipe.
struct Driver {
    std::string vendor, renderer, version;
    bool software = false;
};

// Whether the driver is llvmpipe or another rasteriser that runs on the CPU. The timer queries of
// such a driver are not honest, and its ratios of costs are not those of a GPU.
bool isSoftware(const std::string& renderer);

// One way to an OpenGL 4.5 core context without a window.
struct Device {
    std::string name; // "device 0", "surfaceless": as --device takes it
    Driver driver;
    std::string problem; // why it cannot be used; "" when it can
};

// Probes every EGL device (EGL_EXT_platform_device, what NVIDIA offers) and the surfaceless
// platform (Mesa), in the order of preference: hardware first.
std::vector<Device> devices();

// A headless OpenGL 4.5 core context, current on the calling thread while it lives. Declare it
// before everything made in it.
class Context {
  public:
    // `name` as devices() gives it; "" takes the first that works. An Error lists all that was
    // tried and why each failed.
    explicit Context(const std::string& name = "");
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const Driver& driver() const { return driver_; }

  private:
    struct Display;
    std::unique_ptr<Display> display_;
    Driver driver_;
};

// The current context's own description.
Driver currentDriver();

// From now on the current context stores its errors; throwMessages() raises the first as an Error.
void collectMessages();
void throwMessages();

} // namespace obscura::gl
