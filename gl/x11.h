#pragma once

#include <cstdint>
#include <optional>

struct GLFWwindow;

// What only the X server, or GLX, can say of the window whose context is current. On other window
// systems nothing is known.
namespace obscura::gl {

// When a swap took effect, by the display's own count of vertical blanks.
struct Blank {
    std::int64_t count = 0;
    double time = 0; // seconds on the system's monotonic clock
};

// Whether the driver offers GLX_OML_sync_control, through which Mesa tells the above.
bool countsBlanks();
// Waits until the last swap has taken effect. Nothing when the driver will not say.
std::optional<Blank> awaitBlank();

// Whether a compositing manager runs (it owns the selection _NET_WM_CM_Sn). GLFW asks it to leave
// full-screen windows alone (_NET_WM_BYPASS_COMPOSITOR).
std::optional<bool> compositorRuns();

// Drivers that vary the refresh rate do so for windows with the property _VARIABLE_REFRESH, which
// Mesa sets at the first swap. Takes it back; true when it was set.
std::optional<bool> forbidVariableRefresh(GLFWwindow* window);

} // namespace obscura::gl
