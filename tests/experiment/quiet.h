#pragma once

namespace obscura::test {

// What may hold up a frame, in all threads of this program since it began. Whoever links quiet.cpp
// has it counted.
struct Disturbances {
    int allocations = 0;  // operator new, of libraries too
    int files = 0;        // open, openat, fopen
    int compilations = 0; // shaders compiled or programs linked; code made executable by drivers
};

Disturbances disturbances();
Disturbances operator-(const Disturbances& later, const Disturbances& earlier);

// Counts calls of OpenGL, too: once there is a context.
void listenToShaders();

} // namespace obscura::test
