#pragma once

#include "renderer/scene/scene.h"

#include <glm/glm.hpp>

#include <functional>

namespace obscura::builtin {

// What a painter puts in one place of a texture.
struct Texel {
    glm::vec3 colour{0.5F}; // sRGB code values, 0 ... 1
    float height = 0;       // metres above the surface
    float roughness = 1;
    float alpha = 1;
};
// Of texture coordinates in [0, 1)², v downwards; must repeat at the edges.
using Painter = std::function<Texel(glm::vec2)>;

struct Canvas {
    int size;     // texels across, a power of two
    float metres; // that the texture covers
    bool relief = true;
    bool gloss = false; // roughness varies; else the material's own holds throughout
};
// Paints the textures of a new material and returns its index.
int addMaterial(Scene& scene, Material material, const Canvas& canvas, const Painter& painter);

// Leaves: thin, cut out by alpha, of a texture that covers each once. It has no mipmaps, so that
// the rasteriser's holes are those of rays (RayScene) at any distance.
int addCutOut(Scene& scene, const char* name, int size, const Painter& painter);

// A texture of colours (and alpha) that were worked out elsewhere.
int addColourTexture(Scene& scene, Image8 image);

// Painters. Metres across: see each.
Painter ashlar();      // 4 m: courses of cut sandstone
Painter limestone();   // 1.5 m: pale, veined, pitted
Painter fresco();      // 3 m: a bay of painted plaster; a red dado below panels on ochre
Painter plaster();     // 3 m: rough and stained
Painter flagstones();  // 4 m: worn paving in three widths
Painter marbleFloor(); // 3 m: polished squares and lozenges
Painter timber();      // 2 m: planks along u
Painter cloth(glm::vec3 colour, glm::vec3 trim); // 2 m: a weave with a patterned hem
Painter glaze(glm::vec3 colour);                 // 1 m: a crackled ceramic glaze
Painter frond();                                 // a palm leaf along v, cut out by alpha

Painter grain(glm::vec3 dark, glm::vec3 light);  // 1 m: planed wood, its fibres along u
Painter parquet();                               // 2 m: oak boards along u
Painter weave(float ribs);                       // 1 m: white cloth, to be tinted
Painter limewash(glm::vec3 colour);              // 3 m: a painted wall
Painter rugPattern();                            // covers the rug once
Painter painting();                              // covers the canvas once
Painter speckle(glm::vec3 colour, float amount); // 0.5 m: any plain thing that is not quite

Painter bricks(); // 2 m
Painter bark();   // 1 m, upwards along u
Painter earth();  // 2 m
Painter turf();   // 2 m: what is seen between blades of grass
// A twig along v, cut out by alpha: so many pairs of leaves and one at its tip, of this width to
// length.
Painter twig(int pairs, float width, glm::vec3 dark, glm::vec3 light);
Painter ivy();      // one lobed leaf along v, cut out by alpha
Painter lavender(); // one stalk along v with its flower, cut out by alpha
Painter reed();     // a narrow leaf along v, cut out by alpha

} // namespace obscura::builtin
