#include "renderer/frame/light.h"

#include "renderer/frame/vec3.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {

namespace {

using std::numbers::pi;

std::span<const float, 3> span3(const glm::vec3& v) {
    return std::span<const float, 3>(glm::value_ptr(v), 3);
}

} // namespace

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
    text.add(
        fmt::format("#define CONSTANT_AMBIENT {:d}\n#define SUN {:d}\n#define SCENE_LIGHTS {:d}\n",
                    level.ambient.has_value(), level.sun.has_value(), level.sceneLights),
        "(level)");
    text.addFile(shaderFolder(), "frame.h");
    text.add("layout(std140, binding = 0) uniform FrameBlock { Frame frame; };", "(frame block)");
    text.addFile(shaderFolder(), "light.frag");
    return text;
}

namespace {

constexpr int sceneLightsBinding = 5; // as in shaders/light.frag

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

// As shaders/light.frag has them: position, and 0 for a directional one; where the light goes, and
// the range; intensity; the spot's falloff, scale x cosine + offset (KHR_lights_punctual).
gl::UniformBuffer lightsBlock(const std::vector<PointLight>& lights) {
    std::vector<std::array<glm::vec4, 4>> block(std::max<std::size_t>(lights.size(), 1));
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const PointLight& light = lights[i];
        const bool spot = light.kind == PointLight::Kind::spot;
        const float scale =
            spot ? 1 / std::max(0.001f, light.innerCosine - light.outerCosine) : 0.0f;
        block[i] = {glm::vec4(light.position, light.kind == PointLight::Kind::directional ? 0 : 1),
                    glm::vec4(light.direction, light.range), glm::vec4(light.intensity, 0),
                    glm::vec4(scale, spot ? -light.outerCosine * scale : 1, 0, 0)};
    }
    return gl::UniformBuffer(std::as_bytes(std::span(block)), gl::UniformBuffer::Kind::storage);
}

gl::Texture filteredTexture(std::span<const Image> images) {
    std::vector<gl::FloatLevel> levels;
    for (const Image& image : images)
        levels.push_back({image.width, image.height, image.pixels});
    return gl::filteredTexture(levels);
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
        const Reflections reflections = reflectionsOf(panorama);
        panorama_ = filteredTexture(reflections.levels);
        reflectance_ = filteredTexture(std::span(&reflectanceTable(), 1));
        program_.set("sharpLevel", static_cast<float>(reflections.sharp));
        program_.set("roughLevel", static_cast<float>(reflections.levels.size() - 1));
    }
    if (level.sceneLights)
        sceneLights_ = lightsBlock(scene.lights());
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
    if (panorama_) {
        gl::bindTexture(3, panorama_);
        gl::bindTexture(5, reflectance_);
    }
    environment_.bind(3);
    if (sceneLights_)
        sceneLights_->bind(sceneLightsBinding);
    if (shadow_)
        gl::bindTexture(4, shadow_->depth());
    triangle_.draw();
}

} // namespace obscura
