#pragma once

#include "image/image.h"
#include "renderer/frame/gbuffer.h"
#include "renderer/frame/panorama.h"

#include <filesystem>
#include <optional>

namespace obscura {

glm::vec3 directionOf(const Sun& sun); // towards the sun, world space

// The depth that the sun sees. The map covers the whole scene, so one serves every camera.
class ShadowMap {
  public:
    ShadowMap(const GpuScene& scene, const Sun& sun, int size);

    const gl::Texture& depth() const { return target_.depth(); }
    const glm::mat4& lightFromWorld() const { return lightFromWorld_; }
    float texel() const { return texel_; } // metres

  private:
    gl::Target target_;
    glm::mat4 lightFromWorld_{1};
    float texel_ = 0;
};

// The light that leaves each pixel towards the camera, in scene-linear radiance, split because
// occlusion multiplies the first part only: what comes from everywhere around, scattered and
// mirrored alike.
class LightBuffers {
  public:
    LightBuffers(int width, int height, bool direct);
    const gl::Target& target() const { return target_; }
    const gl::Texture& ambient() const { return target_.colour(0); } // and the background
    bool hasDirect() const { return target_.count() > 1; }
    const gl::Texture& direct() const { return hasDirect() ? target_.colour(1) : none_; }

  private:
    gl::Target target_;
    gl::Texture none_; // black
};

// A level's lighting, ready to draw; what surfaces of each roughness reflect is filtered here,
// once. `environment` is the level's panorama file; unused otherwise.
class Lighting {
  public:
    Lighting(const Level& level, const GpuScene& scene, const std::filesystem::path& environment);

    bool readsNormals() const { return !level_.ambient || hasDirect(); }
    bool hasDirect() const { return level_.sun || level_.sceneLights; }
    // Irradiance for shaders/environment.glsl.
    const gl::UniformBuffer& environment() const { return environment_; }
    // The frame must be bound.
    void draw(const GBuffer& gbuffer, const LightBuffers& light) const;

  private:
    explicit Lighting(const Level& level, const GpuScene& scene, const Image& panorama);

    Level level_;
    gl::Texture panorama_;    // its levels are Reflections; empty where ambient light is constant
    gl::Texture reflectance_; // reflectanceTable(), beside it
    gl::UniformBuffer environment_;
    std::optional<gl::UniformBuffer> sceneLights_;
    std::optional<ShadowMap> shadow_;
    gl::Program program_;
    gl::ScreenTriangle triangle_;
};

// The assembled text of the light shader for a level, for recipes.
gl::ShaderText lightShader(const Level& level);

} // namespace obscura
