// Crytek 2007 as the listing of Kajalin, ShaderX7 2009, is known from engines that took it over;
// the book itself was not at hand. It differs from crytek.glsl in two places: the ball is twice as
// long along the view, and the range term divides by the sample's own depth, so that it engages at
// every scale: a surface at half the pixel's depth is neutral, and with it the darkness that
// crytek.glsl leaves on far walls around near things. Departures as there.
//
// Limit: as crytek.glsl's, with heights along the view halved: a plane 0.5 -> 0.75. Seen from afar,
// beside a step of height h it is what crytek.glsl is beside h / 2.

#include "crytek.glsl"

float ballLength() { return 2.0; }

float tooNear(float depth, float sceneDepth) {
    return clamp((depth - sceneDepth) / max(sceneDepth, frame.depth.x), 0.0, 1.0);
}

vec4 gather(ivec2 pixel) { return boostedAccessibility(pixel); }

vec4 blurTile(ivec2 pixel) { return blurByDepth(gatherResult, pixel); }
