// Light from everywhere around the scene as nine spherical-harmonic coefficients of irradiance
// (renderer/frame/light.h); world directions.
layout(std140, binding = 3) uniform EnvironmentBlock { vec4 irradiance[9]; }
environment;

vec3 harmonicSum(vec3 n, vec3 orders) {
    vec3 sum = orders.x * 0.282095 * environment.irradiance[0].rgb +
               orders.y * 0.488603 *
                   (n.y * environment.irradiance[1].rgb + n.z * environment.irradiance[2].rgb +
                    n.x * environment.irradiance[3].rgb) +
               orders.z * (1.092548 * (n.x * n.y * environment.irradiance[4].rgb +
                                       n.y * n.z * environment.irradiance[5].rgb +
                                       n.x * n.z * environment.irradiance[7].rgb) +
                           0.315392 * (3.0 * n.z * n.z - 1.0) * environment.irradiance[6].rgb +
                           0.546274 * (n.x * n.x - n.y * n.y) * environment.irradiance[8].rgb);
    return max(sum, vec3(0.0));
}

// The irradiance on a surface with this normal.
vec3 irradianceAt(vec3 normal) { return harmonicSum(normal, vec3(1.0)); }

// The radiance whose cosine-weighted integral that is: each order divided by the cosine lobe's
// pi, 2 pi / 3, pi / 4 (Ramamoorthi and Hanrahan 2001, equation 8).
vec3 radianceTowards(vec3 direction) {
    return harmonicSum(direction, vec3(0.318309886, 0.477464829, 1.27323954));
}
