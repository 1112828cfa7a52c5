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
// closed; azimuthOf inverts it to 1.4e-3.
//
// Sines and cosines come from vectors; the only transcendental function of angles is arcCosine.
// Loops over slices and steps test at their end: llvmpipe runs the body of one that tests first
// once more, masked, which took a quarter of the time.

#include "depth_levels.glsl"
#include "hilbert.glsl"

const float pi = 3.14159265;

// Abramowitz and Stegun, formula 4.4.45: good to 6.7e-5. arcCosine(-x) = pi - arcCosine(x), so that
// opposite angles make up pi and a plane stays open.
float arcCosine(float x) {
    float y = abs(x);
    float angle =
        sqrt(max(1.0 - y, 0.0)) * (1.5707288 + y * (-0.2121144 + y * (0.0742610 - y * 0.0187293)));
    return x < 0.0 ? pi - angle : angle;
}

// The pixel, and the frame that its slices stand in.
struct Point {
    ivec2 pixel;
    vec3 position, view; // view: towards the camera
    vec3 tilt, across;   // with the view orthogonal; the normal lies between view and tilt
    float cosine, sine;  // of the angle between normal and view
    float start;         // azimuth of a direction that all pixels share, from the tilt
    float reach;         // metres across the view to a sphere of the radius's silhouette
    vec2 pixelsPerView;  // of x / z and y / z in view space
    float levelScale;    // of pixels along a march: 1 ends level 0
    int coarsest;        // level
};

// Both sides of a slice. Angles are positive on the side that `side` points to.
struct Slice {
    vec3 side;              // unit, across the view
    vec3 upwards, sideways; // a tap's offset in the slice is its products with these
    float turn;             // g
    float cosine, sine;     // of g
    float perWeight;        // 1 / (cos g + g sin g): over the open integral, less l
    vec2 step;              // pixels; one long
};

Point pointOf(ivec2 pixel, float depth) {
    Point p;
    p.pixel = pixel;
    p.position = viewPosition(uvOf(pixel), depth);
    float nearness = inversesqrt(dot(p.position, p.position));
    p.view = -p.position * nearness;
    // Normals of a normal map may face away from the camera; slices need one that does not.
    vec3 normal = texelFetch(normalBuffer, pixel, 0).xyz;
    normal = normalize(normal + p.view * max(0.0, 2e-3 - dot(normal, p.view)));
    p.cosine = clamp(dot(normal, p.view), 1e-3, 1.0);
    vec3 tilt = normal - p.view * p.cosine;
    vec3 other = abs(p.view.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    p.tilt = normalize(dot(tilt, tilt) > 1e-8 ? tilt : cross(p.view, other));
    p.across = cross(p.view, p.tilt);
    p.sine = sqrt(1.0 - p.cosine * p.cosine);
    float start = arcCosine(
        p.tilt.x *
        inversesqrt(max(dot(vec2(p.tilt.x, p.across.x), vec2(p.tilt.x, p.across.x)), 1e-12)));
    p.start = p.across.x < 0.0 ? -start : start;
    float share = settings.radius * nearness;
    p.reach = settings.radius * inversesqrt(max(1.0 - share * share, 0.01));
    p.pixelsPerView = frame.size.xy / frame.viewFromUv.xy;
    p.levelScale = exp2(0.5 - settings.levelOffset);
    p.coarsest = coarsestLevel();
    return p;
}

// Cosine and sine of the azimuth phi up to which slices hold `share` (0 <= share < pi) of pi times
// the cosine-weighted hemisphere. With l cos g = c, l sin g = s cos phi, by parts,
//   share = Int_0^phi l (cos g + g sin g) = acos(cos phi / l) + g s sin phi.
// The halves either side of pi/2 mirror each other. One Newton step from a start, exact for
// surfaces seen face on and edge on, whose sine lies between that of the share and a straight line.
vec2 azimuthOf(Point p, float share) {
    float x = min(share, pi - share);
    float u = x * (2.0 / pi), u2 = u * u, v = 1.0 - p.cosine;
    float bend = u * (0.5707963 +
                      u2 * (-0.6459641 + u2 * (0.0796926 + u2 * -0.0046818 + u2 * u2 * 0.0001604)));
    float blend = 1.0 + v * (-2.6245 + 1.6342 * v + u2 * (2.8999 - 2.9967 * v));
    float sine = min(u + bend * blend, 1.0);
    float cosine = sqrt(1.0 - sine * sine);
    float tilted = p.sine * cosine;
    float perLength = inversesqrt(p.cosine * p.cosine + tilted * tilted);
    float turn = 0.5 * pi - arcCosine(tilted * perLength);
    float reached = arcCosine(min(cosine * perLength, 1.0)) + p.sine * sine * turn;
    float further = (x - reached) / (p.cosine + tilted * turn);
    vec2 azimuth =
        vec2(cosine - sine * further, sine + cosine * further) * (1.0 - 0.5 * further * further);
    return share > 0.5 * pi ? vec2(-azimuth.x, azimuth.y) : azimuth;
}

// `turn` in [0, 1): even turns about the view from a direction that all pixels share, so that the
// noise's pattern survives where surfaces face the camera.
//
// Taps are middles of pixels and lie a little beside the slice. Departure: instead of taking their
// angle as it is, they are moved into the slice parallel to the point's own plane, which keeps
// their height above it. A plane then never occludes itself, at whatever angle it is seen, and no
// bias is needed.
Slice sliceOf(Point p, float turn) {
    vec2 azimuth = azimuthOf(p, mod(turn * pi + p.start, pi));
    Slice slice;
    slice.side = azimuth.x * p.tilt + azimuth.y * p.across;
    vec3 axis = azimuth.x * p.across - azimuth.y * p.tilt;
    float tilted = p.sine * azimuth.x;
    float perLength = inversesqrt(p.cosine * p.cosine + tilted * tilted);
    slice.cosine = p.cosine * perLength;
    slice.sine = tilted * perLength;
    slice.turn = 0.5 * pi - arcCosine(slice.sine);
    slice.perWeight = 1.0 / (slice.cosine + slice.turn * slice.sine);
    vec3 outwards = axis * (-p.sine * azimuth.y * perLength); // the normal's, over l
    slice.upwards = p.view + outwards * slice.cosine;
    slice.sideways = slice.side + outwards * slice.sine;
    vec2 direction = slice.side.xy * -p.position.z + p.position.xy * slice.side.z;
    slice.step = normalize(direction * p.pixelsPerView);
    return slice;
}

// Int_0^a cos(t - turn) sin t dt: of a slice's open integral, the part nearer than `a` to the view
// on one side. `turn` counts towards that side; both come with their cosine and sine.
float arcWeight(float a, vec2 ofA, vec2 ofTurn) {
    float twice = 2.0 * ofA.y;
    return 0.25 * (ofTurn.x * ofA.y * twice + ofTurn.y * (2.0 * a - ofA.x * twice));
}
// Up to the surface's own plane, where a = turn + pi/2.
float sideWeight(float turn, vec2 ofTurn) {
    return 0.5 * ofTurn.x + (0.5 * turn + 0.25 * pi) * ofTurn.y;
}

// Pixels along `step` to where `end` is seen.
float reachTo(Point p, vec3 end, vec2 step) {
    vec2 moved = end.xy / max(-end.z, frame.depth.x) + p.position.xy / p.position.z;
    return -end.z > frame.depth.x ? dot(moved * p.pixelsPerView, step) : 1e6;
}

// How many pixels there are along both sides of a slice, first the one that `side` points to, out
// to the exact silhouette of a sphere of the radius, which lies at asin(radius / distance) from the
// view. They end at the screen's border: beyond it nothing is known and everything counts as open.
// Below 1 there is nothing to see.
vec2 reachesOf(Point p, Slice slice) {
    vec3 across = slice.side * p.reach;
    vec2 reaches = vec2(reachTo(p, p.position + across, slice.step),
                        reachTo(p, p.position - across, -slice.step));
    vec2 start = vec2(p.pixel) + 0.5, perStep = 1.0 / max(abs(slice.step), 1e-6);
    vec2 low = start * perStep, high = (frame.size.xy - start) * perStep;
    bvec2 up = greaterThan(slice.step, vec2(0.0));
    vec2 ahead = mix(low, high, up), behind = mix(high, low, up);
    return min(reaches, vec2(min(ahead.x, ahead.y), min(behind.x, behind.y)));
}

// A tap's surface as seen from the point.
struct Tap {
    vec2 offset;    // towards the view, towards the side; in the slice
    float distance; // metres, squared
    float along;    // metres along the view, in space
    bool seen;      // false: there is nothing
    vec2 uv;        // where it was read
};

// What lies at this depth over a place on the screen; nothing where the march does not get there.
Tap tapOver(Point p, Slice slice, float direction, float reach, vec2 uv, float depth) {
    vec3 offset = viewPosition(uv, depth) - p.position;
    Tap tap;
    tap.distance = dot(offset, offset);
    tap.along = dot(offset, p.view);
    tap.offset = vec2(dot(offset, slice.upwards), direction * dot(offset, slice.sideways));
    tap.seen = reach >= 1.0 && !isEmpty(depth) && tap.offset.y > 0.0;
    tap.uv = uv;
    return tap;
}

// `direction`: 1 on the side that `side` points to, else -1. `place` in [0, 1) is how far along it,
// samplePower applied.
Tap tapAt(Point p, Slice slice, float direction, float reach, float place) {
    float pixels = mix(1.0, reach, place);
    vec2 exact = vec2(p.pixel) + 0.5 + slice.step * (direction * pixels);
    ivec2 pixel = clamp(ivec2(floor(exact)), ivec2(0), ivec2(frame.size.xy) - 1);
    vec2 uv;
    float depth = depthOfTap(pixel, levelOf(pixels * p.levelScale, p.coarsest), uv);
    return tapOver(p, slice, direction, reach, uv, depth);
}

// Where the tap `step` of a slice goes: an even stratum each, jittered anew by the golden ratio.
float tapPlace(float noise, int slice, int step) {
    float jitter = fract(noise + 0.618033989 * float(slice + step * int(settings.steps)));
    return pow((float(step) + jitter) / settings.steps, settings.samplePower);
}
