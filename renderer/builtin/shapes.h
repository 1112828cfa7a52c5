#pragma once

#include "renderer/scene/scene.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace obscura::builtin {

// Triangles that will share one material, counter-clockwise seen from outside. Texture coordinates
// are in metres until addMesh() divides them by the width that the texture covers.
struct Shape {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;

    // A copy of `part`; a mirroring transform turns its triangles round.
    void add(const Shape& part, const glm::mat4& place = glm::mat4(1));
    // Leaves out a triangle of no area, as at the pole of a sphere.
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    // Split where its two triangles agree best with the normals at its corners.
    void addQuad(const std::array<std::uint32_t, 4>& corners);
    // The cells of a grid whose vertices were added last, row by row.
    void addCells(int across, int up);
};

void addMesh(Scene& scene, const Shape& shape, int material, float textureMetres = 1);

// All of it in one colour (sRGB code values, 0 ... 1), with which the material's is multiplied.
Shape tinted(Shape shape, glm::vec3 colour);

glm::mat4 at(glm::vec3 position, float turnDegrees = 0); // turned about y, then moved

// Tilted by `degrees` about the place's own x axis, its top towards +z; about its own z axis.
// (Compilers fold sines of constants to other last bits; they do not see through these calls.)
glm::mat4 pitched(const glm::mat4& place, float degrees);
glm::mat4 rolled(const glm::mat4& place, float degrees);

// i / n in floating point: the place of one of n steps.
inline float part(int i, int n) { return static_cast<float>(i) / static_cast<float>(n); }

// A surface over the unit square; its outside is where du x dv points.
using Surface = std::function<glm::vec3(glm::vec2)>;
// `metres`: the texture coordinates at (1, 1).
Shape patch(const Surface& surface, int across, int up, glm::vec2 metres);

// The cross-section of a moulding: a polyline whose outside is on the right as one walks along it.
// Turns of more than 35 degrees are sharp edges.
using Outline = std::vector<glm::vec2>;
// Appends an arc; angles in degrees, 0 along +x, counter-clockwise.
void addArc(Outline& outline, glm::vec2 centre, float radius, float fromDegrees, float toDegrees,
            int steps);
// A circle to sweep along a path; it closes on itself.
Outline circle(float radius, int steps);

// One place along a sweep, where the outline's point (x, y) becomes origin + x across + y up.
struct Station {
    glm::vec3 origin, across, up;
    glm::vec3 facing; // across as it is without a mitre; normals are made from it
    float along;      // metres from the sweep's beginning
};
// Walking from station to station, outside is on the right of `up`: direction x up = across.
Shape sweep(const Outline& outline, std::span<const Station> stations);

// Turned about the y axis: x is the radius. Begin or end at x = 0 to close it.
Shape lathe(const Outline& outline, int segments);

// Swept along a closed path in plan, points (x, z), with mitred corners; x is the distance to the
// right of the path. A round trip that is clockwise seen from above faces inwards.
Shape moulding(const Outline& outline, std::span<const glm::vec2> plan);
// The same round a centred rectangle, facing outwards. End at x = -width / 2 to close the top of a
// square one.
Shape pillar(const Outline& outline, glm::vec2 size);
// Swept along a curve; x points away from `centre`.
Shape arch(const Outline& outline, std::span<const glm::vec3> path, glm::vec3 centre);

// A round bar along points (xyz) of the given radii (w), closed at both ends.
Shape tube(std::span<const glm::vec4> path, int sides);
Shape rod(glm::vec4 from, glm::vec4 to, int sides = 8); // a straight one

// Centred, with chamfered edges that are shaded as if round.
Shape box(glm::vec3 size, float bevel);
// Centred, with round edges and corners, each edge bent in 2 x `arc` steps; `cells` across each
// flat part, for what is deformed later.
Shape rounded(glm::vec3 size, float radius, int cells = 1, int arc = 3);

// Moves each vertex, and turns its normal as the mapping turns the surface there.
using Mapping = std::function<glm::vec3(glm::vec3)>;
void deform(Shape& shape, const Mapping& mapping);

// In a crease finer than the mesh a triangle may face against the surface's own normal at a corner;
// such a corner takes the mean of the faces that meet there instead.
void mendNormals(Shape& shape);
// What still does, as where a sheet is thinner than a cell, gets flat vertices of its own.
void splitFolds(Shape& shape);

// Texture coordinates by projection along the axis that the normal is nearest to, as stone is cut.
void projectUv(Shape& shape);
// The same of one piece of wood, whose fibres run along its longest side.
void alongGrain(Shape& piece);

} // namespace obscura::builtin
