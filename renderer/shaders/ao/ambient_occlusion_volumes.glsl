// Ambient occlusion volumes (McGuire 2010). What a polygon may occlude lies within the radius of
// it, in a volume drawn over the G-buffer. There each pixel adds the share of its hemisphere, by
// cosine, that the polygon covers: Lambert's sum over the edges of the polygon above the tangent
// plane (Baum, Rushmeier and Winget 1989), 1 / 2 pi sum of angle_i n . (v_i x v_i+1) / |v_i x
// v_i+1|. It is weighted by g = clamp(1 - h / radius)^falloff, h being the height above the
// polygon's plane, by clamp(1 - m / radius) for the distance m outside of each edge's line, and by
// the polygon's coverage, the mean of its alpha.
//
// The paper itself was not at hand: the formulas are those of its author's shader as a port to
// Unity keeps it (speps, GX-AmbientOcclusionVolumes). As in it, polygons are triangles,
// contributions are summed though occluders may hide each other (matching's power makes up for the
// mean of that), and only fronts occlude, so that a closed body counts once. Departures:
// - Triangles of double-sided materials occlude to both sides, for they are sheets.
// - The volume is a box around the triangle and not a prism, whose corners reach the farther the
//   sharper they are; what the weights leave outside of it, beyond sharp corners, is lost.
// - Coverage is the share of the triangle above the material's cutoff, for our holes are sharp.
// - Angles are by a rational function of their cosine (Heitz et al. 2016, "Real-time
// polygonal-light
//   shading with linearly transformed cosines", their code), to about 1e-4 of occlusion.
//
// Limit, as the radius grows against the scene: the cosine-weighted unbounded occlusion, exactly
// where no occluder hides another.

#include "depth.glsl"

// 1 / 2 pi times the angle between two places, along the axis that it turns about.
float edgeShare(vec3 normal, vec3 from, vec3 to) {
    from *= inversesqrt(max(dot(from, from), 1e-30));
    to *= inversesqrt(max(dot(to, to), 1e-30));
    vec3 axis = cross(to, from);
    float cosine = dot(from, to), x = abs(cosine);
    float share = (0.8543985 + (0.4965155 + 0.0145206 * x) * x) /
                  (3.4175940 + (4.1616724 + x) * x); // angle / (2 pi sine)
    if (cosine < 0.0)
        share = 0.5 * inversesqrt(max(dot(axis, axis), 1e-14)) - share;
    return share * dot(normal, axis);
}

// Adds the part above the tangent plane of an edge whose ends have these heights, and keeps where
// it crosses the plane.
void addEdge(inout float share, inout vec3 entry, inout vec3 leaving, vec3 normal, vec3 from,
             vec3 to, float low, float high) {
    if (max(low, high) <= 0.0)
        return;
    vec3 crossing = mix(from, to, low / (low - high));
    if (low <= 0.0)
        entry = from = crossing;
    if (high <= 0.0)
        leaving = to = crossing;
    share += edgeShare(normal, from, to);
}

float shareOfHemisphere(vec3 normal, vec3 a, vec3 b, vec3 c, vec3 heights) {
    float share = 0.0;
    vec3 entry = vec3(0.0), leaving = vec3(0.0);
    addEdge(share, entry, leaving, normal, a, b, heights.x, heights.y);
    addEdge(share, entry, leaving, normal, b, c, heights.y, heights.z);
    addEdge(share, entry, leaving, normal, c, a, heights.z, heights.x);
    return share + edgeShare(normal, leaving, entry);
}

// Height above a polygon's plane, in depths, up to which rounding may lift what lies in it.
const float flatness = 1e-5;

vec4 volumes(ivec2 pixel, Occluder triangle) {
    float depth = depthInside(pixel);
    if (isEmpty(depth))
        discard;
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 a = triangle.a.xyz - position, b = triangle.b.xyz - position,
         c = triangle.c.xyz - position;
    vec3 facing = normalize(cross(b - a, c - a));
    float height = -dot(facing, a);
    if (triangle.b.w > 0.0 && height < 0.0) {
        vec3 swapped = b;
        b = c;
        c = swapped;
        facing = -facing;
        height = -height;
    }
    if (height <= flatness * depth || height >= settings.radius)
        discard;
    vec3 outside =
        vec3(dot(-a, normalize(cross(b - a, facing))), dot(-b, normalize(cross(c - b, facing))),
             dot(-c, normalize(cross(a - c, facing))));
    if (max(outside.x, max(outside.y, outside.z)) >= settings.radius)
        discard;
    vec3 normal = texelFetch(normalBuffer, pixel, 0).xyz;
    vec3 heights = vec3(dot(normal, a), dot(normal, b), dot(normal, c));
    if (max(heights.x, max(heights.y, heights.z)) <= 0.0)
        discard;
    vec3 near = clamp(1.0 - outside / settings.radius, 0.0, 1.0);
    float weight = triangle.a.w * near.x * near.y * near.z *
                   pow(1.0 - height / settings.radius, settings.falloff);
    return vec4(weight * max(shareOfHemisphere(normal, a, b, c, heights), 0.0));
}

vec4 combine(ivec2 pixel) { return vec4(1.0 - texelFetch(volumesResult, pixel, 0).r); }
