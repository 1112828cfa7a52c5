#pragma once

#include "protocols/reader/protocol.h"
#include "renderer/scene/scene.h"

namespace obscura {

// What failure tests look at. Lengths are in radii of the techniques, which are 1 m unless a test
// scales all. Cameras look at what the test is about, so that its distance is the focus distance.

// A floor at y = 0 without anything on it, and a camera above that sees the origin, in the middle
// of the image, at `degrees` from the floor's normal.
Scene floorScene();
Camera floorCamera(double degrees, double distance);

// The convex corner of a box of 4 radii at the origin; the box lies towards -x, -y and -z.
Scene boxScene();
Camera boxCamera();

// A pole along y, `poleWidth` wide, so far before the wall z = 0, and a camera 6 before the pole.
constexpr float poleWidth = 0.5f, poleToCamera = 6;
Scene poleScene(double distance);
Camera poleCamera(double distance);

// Rods of square section along x above the floor y = 0, which they leave free by `rodHeight`.
struct Rod {
    float z, width;
};
constexpr Rod rods[] = {{-3.2f, 0.1f}, {0, 0.25f}, {3.2f, 0.6f}};
constexpr float rodHeight = 0.3f;
Scene rodScene();
Camera rodCamera();

// A floor at y = 0 and a step of 2 radii whose upright face, at x = 0, the camera above it sees
// exactly edge-on, and so does not see.
Scene curbScene();
Camera curbCamera();

// A right angle: the floor y = 0 and the wall x = 0, without end on the side of positive x and y.
// `occlusionInCrease` is the closed form at a distance from the edge (fact sheet, A.1-2).
Scene creaseScene();
double occlusionInCrease(double distance);
// Sees the edge across it, from so many degrees above the floor; `height` radii of the plane
// through the focus fill the image's height.
Camera creaseCamera(double distance, double height, double degrees = 45);
// Looks along the edge at a point of the floor half a radius from the wall and 6 away, which it
// sees at `degrees` from the floor's normal.
Camera creaseCameraAlong(double degrees);

// A closed hall with columns, benches and steps: what games are made of. All lengths times `scale`.
Scene hallScene(double scale = 1);
Camera hallCamera(double scale = 1);

// The camera turned about its line of sight: its upward direction leans right by so many degrees.
Camera rolled(Camera camera, double degrees);

} // namespace obscura
