#include "gl/context.h"

#include "base/error.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace obscura::gl {

namespace {

// A display that could give a context, before it has been tried.
struct Candidate {
    std::string name;
    EGLenum platform = 0;
    void* native = nullptr;
};

bool isSoftware(EGLDeviceEXT device) {
    const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return extensions &&
           std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos;
}

std::vector<Candidate> candidates() {
    std::vector<Candidate> hardware, software;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
        EGLDeviceEXT found[16];
        EGLint count = 0;
        eglQueryDevicesEXT(16, found, &count);
        for (int i = 0; i < count; ++i)
            (isSoftware(found[i]) ? software : hardware)
                .push_back({fmt::format("device {}", i), EGL_PLATFORM_DEVICE_EXT, found[i]});
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        hardware.push_back({"surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY});
    hardware.insert(hardware.end(), software.begin(), software.end());
    return hardware;
}

std::string eglReason(std::string_view what) {
    return fmt::format("{} (EGL error 0x{:x})", what, static_cast<unsigned>(eglGetError()));
}

} // namespace

struct Context::Display {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    ~Display() {
        if (display == EGL_NO_DISPLAY)
            return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT)
            eglDestroyContext(display, context);
        // The display itself is shared by all contexts of the process and stays initialised.
    }

    // Makes a context and makes it current; gives the reason when that fails.
    std::optional<std::string> open(const Candidate& candidate) {
        display = eglGetPlatformDisplayEXT(candidate.platform, candidate.native, nullptr);
        if (display == EGL_NO_DISPLAY)
            return eglReason("no display");
        if (!eglInitialize(display, nullptr, nullptr)) {
            display = EGL_NO_DISPLAY;
            return eglReason("cannot be initialised");
        }
        if (!eglBindAPI(EGL_OPENGL_API))
            return eglReason("no desktop OpenGL");
        const EGLint configWanted[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                       EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(display, configWanted, &config, 1, &count) || count == 0)
            return eglReason("no configuration for OpenGL");
        const EGLint contextWanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                        4,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        5,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, contextWanted);
        if (context == EGL_NO_CONTEXT)
            return eglReason("no OpenGL 4.5 core context");
        if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
            return eglReason("a context without a surface cannot be made current");
        return std::nullopt;
    }
};

namespace {

// The messages of the current context. A C callback cannot throw, so it stores; one vector serves
// because a program has one context at a time.
std::vector<std::string>& messages() {
    thread_local std::vector<std::string> stored;
    return stored;
}

void storeMessage(GLenum, GLenum, GLuint, GLenum, GLsizei length, const GLchar* text, const void*) {
    messages().emplace_back(text, static_cast<std::size_t>(length));
}

} // namespace

bool isSoftware(const std::string& renderer) {
    for (const char* name : {"llvmpipe", "softpipe", "SwiftShader"})
        if (renderer.find(name) != std::string::npos)
            return true;
    return false;
}

Driver currentDriver() {
    const auto text = [](GLenum name) {
        return std::string(reinterpret_cast<const char*>(glGetString(name)));
    };
    Driver driver{text(GL_VENDOR), text(GL_RENDERER), text(GL_VERSION), false};
    driver.software = isSoftware(driver.renderer);
    return driver;
}

void collectMessages() {
    messages().clear();
    glEnable(GL_DEBUG_OUTPUT);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    // Not the shader compiler's: program.cpp reports those itself.
    glDebugMessageControl(GL_DEBUG_SOURCE_API, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, nullptr,
                          GL_TRUE);
    glDebugMessageCallback(storeMessage, nullptr);
}

void throwMessages() {
    // Out-of-memory and the like reach glGetError even where debug output stays silent.
    if (const GLenum error = glGetError(); error != GL_NO_ERROR && messages().empty())
        messages().push_back(fmt::format("error 0x{:x}", error));
    if (messages().empty())
        return;
    const std::string first = messages().front();
    messages().clear();
    throw Error("OpenGL reports: " + first);
}

std::vector<Device> devices() {
    std::vector<Device> result;
    for (const Candidate& candidate : candidates()) {
        Device device{candidate.name, {}, {}};
        try {
            device.driver = Context(candidate.name).driver();
        } catch (const Error& error) {
            device.problem = error.what();
        }
        result.push_back(std::move(device));
    }
    return result;
}

Context::Context(const std::string& name) {
    std::string tried;
    for (const Candidate& candidate : candidates()) {
        if (!name.empty() && candidate.name != name)
            continue;
        auto display = std::make_unique<Display>();
        if (const auto problem = display->open(candidate)) {
            tried += fmt::format("{}{}: {}", tried.empty() ? "" : "; ", candidate.name, *problem);
            continue;
        }
        display_ = std::move(display);
        driver_ = currentDriver();
        collectMessages();
        return;
    }
    throw Error(fmt::format(
        "expected a device with OpenGL 4.5 core through EGL, found none{}{}. Install a driver "
        "(Mesa's software one: apt install libegl1 libgl1-mesa-dri), or see obscura-render "
        "--devices",
        name.empty() ? "" : fmt::format(" named \"{}\"", name),
        tried.empty() ? " (EGL offers neither devices nor the surfaceless platform)"
                      : "; tried " + tried));
}

Context::~Context() = default;

} // namespace obscura::gl
