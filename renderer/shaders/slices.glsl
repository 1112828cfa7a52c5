// What GTAO and the visibility bitmask share: planes through the view vector ("slices"), angles
// within them, and the taps along them.
//
// Write a direction as an angle a from the view vector within the slice of azimuth phi. Then
// dw = |sin a| da dphi, and with the normal's projection into the slice, of length l at angle g,
// the cosine to the normal is l cos(a - g). The cosine-weighted integral of the visibility V is
//   A = 1/pi Int_0^pi l Int V cos(a - g) |sin a| da dphi       (Jimenez et al. 2016, equation 5)
// over g - pi/2 < a < g + pi/2, where the inner integral is elementary (arcWeight below).
//
// Departure: Jimenez et al. take slices at even angles. On a plane seen obliquely these differ
// widely in weight, l (cos g + g sin g), which is noise, and a pixel of few slices may exceed 1. We
// draw slices in proportion to that weight and divide it out, which has the same limit; a plane,
// and a point fully enclosed, are then exact with a single slice. The distribution's integral is
// closed (sliceShare), and two Newton steps invert it to 1e-5.

#include "depth_levels.glsl"
#include "hilbert.glsl"

const float pi = 3.14159265;

// The pixel, and the frame that its slices stand in.
struct Point {
    ivec2 pixel;
    vec3 position, normal, view; // view: towards the camera
    vec3 tilt, across;           // with the view orthogonal; the normal lies between view and tilt
    float cosine, sine;          // of the angle between normal and view
};

struct Slice {
    vec3 side;    // unit, across the view: where angles are positive
    vec3 along;   // for moving taps into the slice
    vec3 axis;    // unit, across the slice
    float turn;   // g
    float weight; // cos g + g sin g: the open integral, less l
};

Point pointOf(ivec2 pixel, float depth) {
    Point p;
    p.pixel = pixel;
    p.position = viewPosition(uvOf(pixel), depth);
    p.view = -normalize(p.position);
    // Interpolated normals may face away from the camera; slices need one that does not.
    vec3 normal = texelFetch(normalBuffer, pixel, 0).xyz;
    p.normal = normalize(normal + p.view * max(0.0, 2e-3 - dot(normal, p.view)));
    p.cosine = clamp(dot(p.normal, p.view), 1e-3, 1.0);
    vec3 tilt = p.normal - p.view * p.cosine;
    vec3 other = abs(p.view.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    p.tilt = normalize(dot(tilt, tilt) > 1e-8 ? tilt : cross(p.view, other));
    p.across = cross(p.view, p.tilt);
    p.sine = sqrt(1.0 - p.cosine * p.cosine);
    return p;
}

// Of the cosine-weighted hemisphere, pi times the share in slices at azimuths 0 to phi from the
// tilt, and its derivative: the integral of l (cos g + g sin g) with l cos g = c, l sin g = s cos
// phi, by parts.
float sliceShare(Point p, float phi) {
    return atan(p.cosine * sin(phi), cos(phi)) +
           p.sine * sin(phi) * atan(p.sine * cos(phi), p.cosine);
}
float sliceDensity(Point p, float phi) {
    return p.cosine + p.sine * cos(phi) * atan(p.sine * cos(phi), p.cosine);
}

// 0 <= share < pi. The halves either side of pi/2 mirror each other; the start is exact for a
// surface seen face on and edge on.
float azimuthOf(Point p, float share) {
    float x = min(share, pi - share);
    float sine2 = p.sine * p.sine;
    float phi = mix(x, asin(min(x * 2.0 / pi, 1.0)), sine2 * sine2);
    for (int i = 0; i < 2; ++i)
        phi = clamp(phi + (x - sliceShare(p, phi)) / sliceDensity(p, phi), 0.0, 0.5 * pi);
    return share > 0.5 * pi ? pi - phi : phi;
}

// `turn` in [0, 1): even turns about the view from a direction that all pixels share, so that the
// noise's pattern survives where surfaces face the camera.
Slice sliceOf(Point p, float turn) {
    vec3 reference = vec3(1.0, 0.0, 0.0) - p.view * p.view.x;
    float start = atan(dot(reference, p.across), dot(reference, p.tilt));
    float phi = azimuthOf(p, mod(turn * pi + start, pi));
    Slice slice;
    slice.side = cos(phi) * p.tilt + sin(phi) * p.across;
    slice.axis = cross(p.view, slice.side);
    float outwards = dot(p.normal, slice.axis);
    slice.along = (slice.axis - p.normal * outwards) / max(1.0 - outwards * outwards, 1e-6);
    slice.turn = atan(dot(p.normal, slice.side), p.cosine);
    slice.weight = cos(slice.turn) + slice.turn * sin(slice.turn);
    return slice;
}

// Int_0^a cos(t - turn) sin t dt: of a slice's open integral, the part nearer than `a` to the view
// on one side. `turn` counts towards that side. The sines and cosines are a's.
float arcWeight(float a, vec2 cosineSine, float turn) {
    float twice = cosineSine.x * cosineSine.x - cosineSine.y * cosineSine.y;
    float twiceSine = 2.0 * cosineSine.x * cosineSine.y;
    return 0.25 * (cos(turn) * (1.0 - twice) + sin(turn) * (2.0 * a - twiceSine));
}
// Up to the surface's own plane, where a = turn + pi/2.
float sideWeight(float turn) { return 0.5 * cos(turn) + (0.5 * turn + 0.25 * pi) * sin(turn); }

// One side of a slice on the screen.
struct March {
    vec2 start, step; // pixels; `step` is one long
    float reach;      // pixels; below 1: nothing to see
};

// As far as a sphere of the radius can be seen, exactly: its silhouette lies at asin(radius /
// distance) from the view. And no farther than the screen, beyond which nothing is known: that is
// open.
March marchOf(Point p, vec3 side) {
    float depth = -p.position.z;
    March march;
    march.start = vec2(p.pixel) + 0.5;
    vec2 direction = (side.xy * depth + p.position.xy * side.z) / frame.viewFromUv.xy;
    march.step = normalize(direction * frame.size.xy);
    float share = settings.radius / length(p.position);
    vec3 end = p.position + side * settings.radius * inversesqrt(max(1.0 - share * share, 0.01));
    march.reach =
        -end.z > frame.depth.x ? distance(uvFromView(end) * frame.size.xy, march.start) : 1e6;
    vec2 room = mix(march.start, frame.size.xy - march.start, greaterThan(march.step, vec2(0.0))) /
                max(abs(march.step), 1e-6);
    march.reach = min(march.reach, min(room.x, room.y));
    return march;
}

// A tap's surface as seen from the point.
struct Tap {
    vec2 offset;    // towards the view, towards the side; in the slice
    float distance; // metres, in space
    float along;    // metres along the view, in space
};

// `place` in [0, 1) along the march. False: there is nothing to see.
//
// Taps are middles of pixels and lie a little beside the slice. Departure: instead of taking their
// angle as it is, they are moved into the slice parallel to the point's own plane, which keeps
// their height above it. A plane then never occludes itself, at whatever angle it is seen, and no
// bias is needed.
bool tapAt(Point p, Slice slice, March march, float place, vec3 side, out Tap tap) {
    float pixels = mix(1.0, march.reach, pow(place, settings.samplePower));
    ivec2 pixel =
        clamp(ivec2(floor(march.start + march.step * pixels)), ivec2(0), ivec2(frame.size.xy) - 1);
    vec2 uv;
    float depth = depthOfTap(pixel, pixels, uv);
    vec3 offset = viewPosition(uv, depth) - p.position;
    tap.distance = length(offset);
    tap.along = dot(offset, p.view);
    vec3 moved = offset - dot(offset, slice.axis) * slice.along;
    tap.offset = vec2(dot(moved, p.view), dot(moved, side));
    return !isEmpty(depth) && tap.offset.y > 0.0;
}

// Where the tap `step` of a slice goes: an even stratum each, jittered anew by the golden ratio.
float tapPlace(float noise, int slice, int step) {
    float jitter = fract(noise + 0.618033989 * float(slice + step * int(settings.steps)));
    return (float(step) + jitter) / settings.steps;
}
