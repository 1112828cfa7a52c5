#pragma once

#include "image/image.h"
#include "protocols/reader/study.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace obscura {

// Light from everywhere around the scene: an equirectangular panorama of radiance, 3 channels, top
// row at the zenith, its centre column towards -z, +x to the right of it.
Image skyPanorama(const Sky& sky);

// The world direction of a place on a panorama; u and v from 0 to 1, v from the top.
glm::dvec3 panoramaDirection(double u, double v);

// Irradiance as nine coefficients of the real spherical harmonics of orders 0 to 2, each an RGB
// triple, already convolved with the cosine lobe (Ramamoorthi and Hanrahan 2001): the irradiance
// on a surface with world normal n is the sum of coefficient times basis function at n.
using Irradiance = std::array<std::array<float, 3>, 9>;
Irradiance irradianceOf(const Image& panorama);

// A panorama as surfaces reflect it: the first factor of the split sum (Karis 2013, "Real shading
// in Unreal Engine 4"), its mean over GGX's lobe around a direction, seen along the normal.
struct Reflections {
    // Panoramas, each half as wide and high as the one before, rounded down.
    std::vector<Image> levels;
    // Up to this level they are the panorama itself, smaller each time; from here, roughness grows
    // evenly from 0 to 1 at the last level.
    int sharp = 0;
};
Reflections reflectionsOf(const Image& panorama);

// The second factor: how much of light that is everywhere the same a surface mirrors, GGX with
// Smith's masking of both directions together (Heitz 2014), as scale (channel 0) and offset (1) of
// its reflectance face-on, by Schlick's Fresnel term. Columns from a cosine of 0 between normal and
// eye to 1, rows from a roughness of 0 to 1, both at their borders' very values. Within 0.01 of the
// integral where the cosine is above 0.1.
const Image& reflectanceTable();

} // namespace obscura
