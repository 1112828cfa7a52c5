#pragma once

#include <string>
#include <vector>

namespace obscura::test {

// Something that may hold up a frame, in any thread of this program. Whoever links quiet.cpp has it
// noted.
struct Disturbance {
    enum class Kind {
        allocation,  // malloc and its kin, operator new too
        file,        // opened, or read, written or synced
        compilation, // shaders given, compiled or linked; code made executable by drivers
        upload,      // pixels or vertices given to OpenGL, or room for them taken
    };
    Kind kind{};
    // Whose code asked for it: the file name of the innermost module of the call that is neither
    // libc nor libstdc++; "ours" for this program itself.
    std::string by;
    std::string
        how; // the call: modules and addresses, innermost first; ours as addr2line takes them
};

// Nothing is noted but between listen(true) and listen(false).
void listen(bool on);
// What was noted since it was last asked for.
std::vector<Disturbance> heard();

// Notes calls of OpenGL, too: once there is a context.
void listenToOpenGl();

// How often each kind stands there by whom, in words.
std::string summary(const std::vector<Disturbance>& all);

} // namespace obscura::test
