#include "renderer/frame/light.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {

namespace {

constexpr double pi = std::numbers::pi;

glm::dvec3 vec(const Vec3& v) { return {v[0], v[1], v[2]}; }

std::span<const float, 3> span3(const glm::vec3& v) {
    return std::span<const float, 3>(glm::value_ptr(v), 3);
}

// World direction of a panorama's pixel centre. The sphere's area per pixel falls with its sine.
glm::dvec3 panoramaDirection(double u, double v) {
    const double longitude = (u - 0.5) * 2 * pi, colatitude = v * pi;
    return {std::sin(colatitude) * std::sin(longitude), std::cos(colatitude),
            -std::sin(colatitude) * std::cos(longitude)};
}

// Real spherical harmonics, orders 0 to 2, in the order of shaders/light.frag.
std::array<double, 9> basis(const glm::dvec3& d) {
    return {0.282095,
            0.488603 * d.y,
            0.488603 * d.z,
            0.488603 * d.x,
            1.092548 * d.x * d.y,
            1.092548 * d.y * d.z,
            0.315392 * (3 * d.z * d.z - 1),
            1.092548 * d.x * d.z,
            0.546274 * (d.x * d.x - d.y * d.y)};
}

} // namespace

Image skyPanorama(const Sky& sky) {
    Image image{256, 128, 3, std::vector<float>(256 * 128 * 3)};
    for (int y = 0; y < image.height; ++y) {
        const double elevation = 90 - 180 * (y + 0.5) / image.height; // degrees
        // Haze: the horizon's colour fades upwards within some thirty degrees, into the ground
        // within a few.
        const double up = 1 - std::exp(-std::max(elevation, 0.0) / 20);
        const double down = std::clamp(-elevation / 4, 0.0, 1.0);
        const glm::dvec3 colour = glm::mix(glm::mix(vec(sky.horizon), vec(sky.zenith), up),
                                           vec(sky.ground), down * down * (3 - 2 * down));
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = static_cast<float>(colour[c]);
    }
    return image;
}

Irradiance irradianceOf(const Image& panorama) {
    std::array<glm::dvec3, 9> sums{};
    for (int y = 0; y < panorama.height; ++y) {
        const double v = (y + 0.5) / panorama.height;
        const double area = 2 * pi * pi * std::sin(v * pi) /
                            (static_cast<double>(panorama.width) * panorama.height);
        for (int x = 0; x < panorama.width; ++x) {
            const auto value = basis(panoramaDirection((x + 0.5) / panorama.width, v));
            const glm::dvec3 radiance(panorama.at(x, y, 0), panorama.at(x, y, 1),
                                      panorama.at(x, y, 2));
            for (std::size_t i = 0; i < 9; ++i)
                sums[i] += radiance * (value[i] * area);
        }
    }
    // Ramamoorthi and Hanrahan 2001, equation 9: the cosine lobe's own coefficients.
    const double lobe[3] = {pi, 2 * pi / 3, pi / 4};
    Irradiance result;
    for (std::size_t i = 0; i < 9; ++i)
        for (int c = 0; c < 3; ++c)
            result[i][static_cast<std::size_t>(c)] =
                static_cast<float>(sums[i][c] * lobe[i == 0  ? 0
                                                     : i < 4 ? 1
                                                             : 2]);
    return result;
}

glm::vec3 directionOf(const Sun& sun) {
    const double azimuth = glm::radians(sun.azimuthDegrees),
                 elevation = glm::radians(sun.elevationDegrees);
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            std::cos(elevation) * std::cos(azimuth)};
}

ShadowMap::ShadowMap(const GpuScene& scene, const Sun& sun, int size)
    : target_(size, size, {}, true, "shadow map") {
    const glm::vec3 towards = directionOf(sun);
    const glm::vec3 centre = (scene.bounds().low + scene.bounds().high) * 0.5f;
    const float radius = glm::length(scene.bounds().high - centre) * 1.001f + 1e-6f;
    const glm::vec3 up = std::abs(towards.y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::mat4 view = glm::lookAt(centre + towards * radius, centre, up);
    lightFromWorld_ = glm::orthoRH_ZO(-radius, radius, -radius, radius, 0.0f, 2 * radius) * view;
    texel_ = 2 * radius / static_cast<float>(size);

    target_.bind();
    gl::State state;
    state.depth = gl::State::Depth::forward;
    state.slopeBias = 2;
    state.constantBias = 2;
    state.apply();
    target_.clearDepth(1);
    DepthPass().draw(scene, lightFromWorld_, false, state);
}

namespace {

std::vector<gl::Format> lightFormats(bool direct) {
    return std::vector<gl::Format>(direct ? 2 : 1, gl::Format::rgba16f);
}

// 4096 texels over Sponza are 9 mm each.
constexpr int shadowMapSize = 4096;

} // namespace

LightBuffers::LightBuffers(int width, int height, bool direct)
    : target_(width, height, lightFormats(direct), false, "light"),
      none_(gl::constantTexture({0, 0, 0, 0})) {}

gl::ShaderText lightShader(const Level& level) {
    gl::ShaderText text;
    // Parts of the shader that a level does not need, and the buffers they read, do not exist.
    text.add(fmt::format("#define CONSTANT_AMBIENT {:d}\n#define SUN {:d}\n",
                         level.ambient.has_value(), level.sun.has_value()),
             "(level)");
    text.addFile(shaderFolder(), "frame.h");
    text.add("layout(std140, binding = 0) uniform FrameBlock { Frame frame; };", "(frame block)");
    text.addFile(shaderFolder(), "light.frag");
    return text;
}

namespace {

// Empty with constant ambient light.
Image panoramaOf(const Level& level, const std::filesystem::path& environment) {
    return level.ambient ? Image{}
           : level.sky   ? skyPanorama(*level.sky)
                         : readImage(environment, 3);
}

// Constant radiance L arrives as irradiance pi L whichever way a surface faces.
Irradiance constantIrradiance(const Vec3& radiance) {
    Irradiance result{};
    for (std::size_t c = 0; c < 3; ++c)
        result[0][c] = static_cast<float>(pi * radiance[c] / 0.282095);
    return result;
}

gl::UniformBuffer environmentBlock(const Irradiance& irradiance) {
    std::array<glm::vec4, 9> block{};
    for (std::size_t i = 0; i < 9; ++i)
        block[i] = {irradiance[i][0], irradiance[i][1], irradiance[i][2], 0};
    return gl::UniformBuffer(std::as_bytes(std::span(block)));
}

} // namespace

Lighting::Lighting(const Level& level, const GpuScene& scene,
                   const std::filesystem::path& environment)
    : Lighting(level, scene, panoramaOf(level, environment)) {}

Lighting::Lighting(const Level& level, const GpuScene& scene, const Image& panorama)
    : level_(level),
      environment_(environmentBlock(level.ambient ? constantIrradiance(*level.ambient)
                                                  : irradianceOf(panorama))),
      program_("light", shaderText("screen.vert"), lightShader(level)) {
    if (level.sun)
        shadow_.emplace(scene, *level.sun, shadowMapSize);
    if (level.ambient) {
        program_.set("ambient", span3(glm::vec3(vec(*level.ambient))));
        program_.set("background", span3(glm::vec3(vec(level.background))));
    } else {
        panorama_ = gl::panoramaTexture(panorama.width, panorama.height, panorama.pixels);
    }
    if (level.sun) {
        program_.set("sunDirection", span3(directionOf(*level.sun)));
        program_.set("sunIrradiance", span3(glm::vec3(vec(level.sun->irradiance))));
        program_.set("shadowTexel", shadow_->texel());
        program_.setMatrix("lightFromWorld", std::span<const float, 16>(
                                                 glm::value_ptr(shadow_->lightFromWorld()), 16));
    }
}

void Lighting::draw(const GBuffer& gbuffer, const LightBuffers& light) const {
    light.target().bind();
    gl::State{}.apply();
    program_.use();
    gl::bindTexture(0, gbuffer.albedo());
    gl::bindTexture(1, gbuffer.depth());
    if (readsNormals())
        gl::bindTexture(2, *gbuffer.shadingNormal());
    if (panorama_)
        gl::bindTexture(3, panorama_);
    environment_.bind(3);
    if (shadow_)
        gl::bindTexture(4, shadow_->depth());
    triangle_.draw();
}

} // namespace obscura
