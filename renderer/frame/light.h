#pragma once

#include "image/image.h"
#include "renderer/frame/gbuffer.h"

#include <array>
#include <filesystem>
#include <optional>

namespace obscura {

// Light from everywhere around the scene: an equirectangular panorama of radiance, 3 channels, top
// row at the zenith, its centre column towards -z, +x to the right of it.
Image skyPanorama(const Sky& sky);

// Irradiance as nine coefficients of the real spherical harmonics of orders 0 to 2, each an RGB
// triple, already convolved with the cosine lobe (Ramamoorthi and Hanrahan 2001): the irradiance
// on a surface with world normal n is the sum of coefficient times basis function at n.
using Irradiance = std::array<std::array<float, 3>, 9>;
Irradiance irradianceOf(const Image& panorama);

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
// occlusion multiplies the first part only.
class LightBuffers {
  public:
    LightBuffers(int width, int height, bool direct);
    const gl::Target& target() const { return target_; }
    const gl::Texture& ambient() const { return target_.colour(0); } // and the background
    const gl::Texture& direct() const { return target_.count() > 1 ? target_.colour(1) : none_; }

  private:
    gl::Target target_;
    gl::Texture none_; // black
};

// A level's lighting, ready to draw. `environment` is the level's panorama file; unused otherwise.
class Lighting {
  public:
    Lighting(const Level& level, const GpuScene& scene, const std::filesystem::path& environment);

    bool readsNormals() const { return !level_.ambient || level_.sun; }
    bool hasDirect() const { return level_.sun.has_value(); }
    // Irradiance for shaders/environment.glsl.
    const gl::UniformBuffer& environment() const { return environment_; }
    // The frame must be bound.
    void draw(const GBuffer& gbuffer, const LightBuffers& light) const;

  private:
    explicit Lighting(const Level& level, const GpuScene& scene, const Image& panorama);

    Level level_;
    gl::Texture panorama_; // empty where ambient light is constant
    gl::UniformBuffer environment_;
    std::optional<ShadowMap> shadow_;
    gl::Program program_;
    gl::ScreenTriangle triangle_;
};

// The assembled text of the light shader for a level, for recipes.
gl::ShaderText lightShader(const Level& level);

} // namespace obscura
