#pragma once

#include "renderer/builtin/shapes.h"

// What stands and hangs in the atrium. On y = 0 and centred on the y axis unless said otherwise.
namespace obscura::builtin {

// A curtain in an opening of the given size along x, drawn back to both sides: two panels of cloth,
// thin, their texture running once from rail to hem.
Shape curtains(float width, float height);
// Cloth over a rail whose top is the origin, facing +z: `back` metres of it hang behind, `front`
// before, where it rests on a ledge.
struct Ledge {
    float out, below; // from the rail
};
Shape banner(float width, float back, float front, const Ledge& ledge);

Shape amphora(float height);
Shape urn(float height); // wide, open: for a plant
// Fronds that rise from the origin and arch outwards; one texture for each.
Shape palm(int fronds, float length);

struct Fountain {
    Shape stone, water;
};
Fountain fountain(float radius);

// A double door with raised panels, facing +z, its middle at z = 0; for an arch of this radius.
Shape door(float radius, float springing);

} // namespace obscura::builtin
