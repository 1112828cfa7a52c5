// Ambient occlusion by few rays a pixel: cosine-weighted visibility within the radius (Zhukov et
// al. 1998), traced by Embree on the CPU (renderer/reference/few_rays.h) and filtered here.
//
// A ray is the normal plus a point of the unit sphere, which makes directions as dense as their
// cosine. The points of a pixel follow each other in the R2 sequence, and those of pixels in the
// order of a Hilbert curve (hilbert.glsl).
//
// Limit with infinitely many rays and no filter: the ray-traced reference itself.

#include "ray_filter.glsl"

vec4 gather(ivec2 pixel) { return texelFetch(tracedBuffer, pixel, 0); }
