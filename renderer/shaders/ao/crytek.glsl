// Crytek 2007 in the form of Jakobsen 2010, appendix A (after Kajalin, ShaderX7 2009). Depth only.
//
// In the limit it is the open fraction of a ball around the pixel, then a non-linear boost: an open
// plane reads 0.5 -> 0.75, a right-angled convex edge 0.75 -> 1 (the bright edges of the
// technique), a concave one 0.25 -> 0.3125. All three are faithful, not faults of this file.
//
// Two departures, both so that the radius can be matched in metres. The appendix leaves offsets in
// texture coordinates, an ellipse 16/9 wider than tall; ours are round on screen. And it scales the
// depth offset by the depth itself, which is a sphere only at a field of view of 53 degrees; ours
// is a sphere at any. As in the appendix, the ball is constant on screen: it has `radius` metres at
// the focus distance and grows in proportion to depth.

#include "crytek.glsl"

float ballLength() { return 1.0; }

float tooNear(float depth, float sceneDepth) {
    return clamp((depth - sceneDepth) / (settings.range * settings.radius), 0.0, 1.0);
}

vec4 gather(ivec2 pixel) { return boostedAccessibility(pixel); }

vec4 blurTile(ivec2 pixel) { return blurByDepth(gatherResult, pixel); }
