// Taps into the depth buffer itself; at a stride of 2 they read just what a half-resolution copy
// made of every second pixel would hold.

#include "depth.glsl"
#include "taps.glsl"

float tapDepth(ivec2 cell, ivec2 place, int stride) { return depthOf(cell * stride + place); }
