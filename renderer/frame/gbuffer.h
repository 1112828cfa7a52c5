#pragma once

#include "gl/draw.h"
#include "gl/program.h"
#include "gl/target.h"
#include "protocols/reader/protocol.h"
#include "renderer/scene/scene.h"
#include "renderer/shaders/frame.h"

#include <optional>

namespace obscura {

// The block that tells shaders where a camera's pixels are. `bounds` decides the depth of empty
// pixels (beyond the scene); `jitter` moves the image by a fraction of a pixel, -0.5 ... 0.5. A
// frame with `guard` is that many pixels wider on every side, and its middle is the frame without.
Frame makeFrame(const Camera& camera, int width, int height, const Bounds& bounds,
                std::uint64_t seed, glm::vec2 jitter = {0, 0}, int guard = 0);

// Metres from the camera to its near plane: what the camera says or, where it says nothing, 5 cm.
// In a scene that is less than 1 m across it is a twentieth of the scene's diagonal.
double nearPlane(const Camera& camera, const Bounds& bounds);

// A scene in the GPU's memory.
class GpuScene {
  public:
    explicit GpuScene(const Scene& scene);

    const Bounds& bounds() const { return bounds_; }
    // Which materials a draw() takes, and whether it skips back faces that cannot be seen (those of
    // materials that are not double-sided).
    enum class Take { all, opaque, masked };
    // The program must read shaders/material.glsl, unless it draws nothing but the depth of opaque
    // materials.
    void draw(const gl::Program& program, Take take, bool cullBackFaces, gl::State state) const;

  private:
    const gl::Texture& texture(int index) const;
    void bindMaterial(const gl::Program& program, const Material& material) const;

    Bounds bounds_;
    std::vector<Mesh> meshes_;
    std::vector<Material> materials_;
    gl::Geometry geometry_;
    std::vector<gl::Texture> textures_;
    gl::Texture white_;
};

// What a G-buffer holds besides depth.
struct GBufferContent {
    bool albedo = true;
    bool shadingNormal = false;             // with the normal map
    std::optional<Normals> occlusionNormal; // for techniques and references
};

// What is seen at each pixel. View space as in shaders/view.glsl. Buffers that were not asked for
// do not exist; an occlusion normal that is `mapped` is the shading normal.
class GBuffer {
  public:
    GBuffer(int width, int height, GBufferContent content);

    const gl::Target& target() const { return target_; }
    const GBufferContent& content() const { return content_; }
    // sRGB; alpha: specular intensity.
    const gl::Texture& albedo() const { return target_.colour(0); }
    // Linear view depth, metres.
    const gl::Texture& depth() const { return target_.colour(1); }
    // View-space unit vectors; null where there is none.
    const gl::Texture* shadingNormal() const; // alpha: specular power
    const gl::Texture* occlusionNormal() const;

  private:
    GBufferContent content_;
    gl::Target target_;
};

// Uploads a frame to binding 0, where every shader expects it.
void bindFrame(const gl::UniformBuffer& frame);
gl::UniformBuffer frameBuffer(const Frame& frame);

// Draws depth alone, with holes where masked materials have them. It goes before the G-buffer's
// pass, which then shades each pixel once, and it draws the sun's shadow map.
class DepthPass {
  public:
    DepthPass();
    void draw(const GpuScene& scene, const glm::mat4& clipFromWorld, bool cullBackFaces,
              const gl::State& state) const;

    static gl::ShaderText fragmentShader(bool masked);

  private:
    gl::Program opaque_, masked_;
};

class GBufferPass {
  public:
    GBufferPass();
    // The frame must be bound.
    void draw(const GpuScene& scene, const Frame& frame, const GBuffer& gbuffer) const;

  private:
    DepthPass depth_;
    gl::Program program_;
};

// The text of shaders/NAME with the frame block in front.
gl::ShaderText shaderText(const std::string& name);
std::filesystem::path shaderFolder();

} // namespace obscura
