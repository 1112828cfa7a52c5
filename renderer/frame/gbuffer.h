#pragma once

#include "gl/draw.h"
#include "gl/program.h"
#include "gl/target.h"
#include "protocols/reader/protocol.h"
#include "renderer/scene/scene.h"
#include "renderer/shaders/frame.h"

#include <compare>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace obscura {

// The block that tells shaders where a camera's pixels are. `bounds` decides the depth of empty
// pixels (beyond the scene); `jitter` moves the image by a fraction of a pixel, -0.5 ... 0.5. A
// frame with `guard` is that many pixels wider on every side, and its middle is the frame without.
Frame makeFrame(const Camera& camera, int width, int height, const Bounds& bounds,
                std::uint64_t seed, glm::vec2 jitter = {0, 0}, int guard = 0);

// Metres from the camera to its near plane: what the camera says or, where it says nothing, 5 cm.
// In a scene that is less than 1 m across it is a twentieth of the scene's diagonal.
double nearPlane(const Camera& camera, const Bounds& bounds);

// What a mesh's material asks of shaders beyond the plain ones (shaders/material.glsl). Each
// combination has programs of its own, compiled when it is first met, so that a scene pays for
// nothing that it does not have.
struct MaterialFeatures {
    bool masked = false;      // has holes
    bool transformed = false; // not all its textures read Vertex::uv as it is
    bool coloured = false;    // by its vertices
    bool glossiness = false;  // specular-glossiness in place of metallic-roughness

    auto operator<=>(const MaterialFeatures&) const = default;
};

// A scene in the GPU's memory.
class GpuScene {
  public:
    explicit GpuScene(const Scene& scene);

    const Bounds& bounds() const { return bounds_; }
    // Those of its meshes, each once.
    const std::set<MaterialFeatures>& features() const { return kinds_; }
    // Whether textures are filtered anisotropically from now on, as at first. Without, they are
    // blurred where they are seen at grazing angles, and software rasterisers take half the time.
    void sharpen(bool sharp) const;
    bool sharpens() const { return !anisotropic_.empty(); } // any texture
    // Whether anything shows light of its own, so that a G-buffer should hold emission.
    bool emits() const { return emits_; }
    const std::vector<PointLight>& lights() const { return lights_; }

    // The meshes that have these features, by a program of shaders/material.glsl: `forDepth` reads
    // nothing but alpha, `withEmission` the emission too. Back faces that cannot be seen, those of
    // materials that are not double-sided, may be left out. What lies outside of the picture that
    // `clipFromWorld` gives is left out.
    enum class Reads { forDepth, withoutEmission, withEmission };
    void draw(const gl::Program& program, const glm::mat4& clipFromWorld,
              const MaterialFeatures& features, Reads reads, bool cullBackFaces,
              gl::State state) const;
    // All that have no holes, by a program that reads nothing of their materials.
    void drawOpaque(const gl::Program& program, const glm::mat4& clipFromWorld, bool cullBackFaces,
                    gl::State state) const;

  private:
    const gl::Texture& texture(const TextureUse& use) const;
    void bindMaterial(const gl::Program& program, const Material& material,
                      const MaterialFeatures& features, Reads reads) const;
    void drawMesh(std::size_t index, std::span<const Mesh> seen, bool cullBackFaces,
                  gl::State& state) const;

    // Some hundred triangles of a mesh, that follow each other, and a box around them.
    struct Piece {
        std::uint32_t firstIndex, indexCount;
        Bounds bounds;
    };
    static std::vector<Piece> piecesOf(const Scene& scene, const Mesh& mesh);
    // The runs of a mesh's triangles that may be in the picture.
    std::vector<Mesh> seen(std::size_t index, const glm::mat4& clipFromWorld) const;

    Bounds bounds_;
    std::vector<Mesh> meshes_;
    std::vector<std::vector<Piece>> pieces_; // of each mesh
    std::vector<MaterialFeatures> features_; // the same
    std::set<MaterialFeatures> kinds_;
    bool emits_ = false;
    std::vector<Material> materials_;
    std::vector<PointLight> lights_;
    gl::Geometry geometry_;
    std::vector<gl::Texture> textures_;
    std::vector<std::size_t> anisotropic_; // of them
    mutable bool sharp_ = true;
    gl::Texture white_;
};

// What a G-buffer holds besides depth.
struct GBufferContent {
    bool albedo = true;
    bool shadingNormal = false;             // with the normal map
    std::optional<Normals> occlusionNormal; // for techniques and references
    bool emission = false;                  // for the composite, where GpuScene::emits()
};

// What is seen at each pixel. View space as in shaders/view.glsl. Buffers that were not asked for
// do not exist; an occlusion normal that is `mapped` is the shading normal.
class GBuffer {
  public:
    GBuffer(int width, int height, GBufferContent content);

    const gl::Target& target() const { return target_; }
    const GBufferContent& content() const { return content_; }
    // Base colour, sRGB; alpha: metallic. Both are 0 and 1 where the material is unlit.
    const gl::Texture& albedo() const { return target_.colour(0); }
    // Linear view depth, metres.
    const gl::Texture& depth() const { return target_.colour(1); }
    // View-space unit vectors; null where there is none.
    const gl::Texture* shadingNormal() const; // alpha: roughness
    const gl::Texture* occlusionNormal() const;
    // Linear radiance that surfaces send by themselves; null where it was not asked for.
    const gl::Texture* emission() const;

  private:
    GBufferContent content_;
    gl::Target target_;
};

// Uploads a frame to binding 0, where every shader expects it.
void bindFrame(const gl::UniformBuffer& frame);
gl::UniformBuffer frameBuffer(const Frame& frame);

// Draws depth alone, with holes where masked materials have them. It goes before the G-buffer's
// pass, which then shades each pixel once, and it draws the sun's shadow map. One that `peels`
// draws only what lies `separation` metres of view depth behind the texture at unit `beforeUnit`,
// or farther, and linear view depth into the target's first colour.
class DepthPass {
  public:
    static constexpr int beforeUnit = 4;

    explicit DepthPass(bool peels = false);
    void draw(const GpuScene& scene, const glm::mat4& clipFromWorld, bool cullBackFaces,
              const gl::State& state, float separation = 0) const;

  private:
    const gl::Program& masked(const MaterialFeatures& features) const;

    bool peels_;
    gl::Program opaque_;
    mutable std::map<MaterialFeatures, gl::Program> masked_; // by features that decide alpha
};

class GBufferPass {
  public:
    GBufferPass();
    // The frame must be bound.
    void draw(const GpuScene& scene, const Frame& frame, const GBuffer& gbuffer) const;

    // Depth peeling (Everitt 2001), one layer further: of what draw() would draw, the nearest that
    // lies at least `separation` metres of view depth behind `before`, which is linear view depth
    // of the layer before (GBuffer::depth() is the first). `layer` has the size of the frame, one
    // colour r32f, which becomes linear view depth, and a depth buffer. Empty pixels hold
    // frame.depth.y.
    void peel(const GpuScene& scene, const Frame& frame, const gl::Texture& before,
              float separation, const gl::Target& layer) const;

  private:
    const gl::Program& program(const MaterialFeatures& features, bool emission) const;

    DepthPass depth_;
    mutable std::optional<DepthPass> peel_; // compiled when it is first asked for
    mutable std::map<std::pair<MaterialFeatures, bool>, gl::Program> programs_;
};

// The texts of all shaders that draw a G-buffer, for recipes: every variant is one of them with
// other constants at its head.
std::string gbufferShaders();

// The text of shaders/NAME with the frame block in front.
gl::ShaderText shaderText(const std::string& name);
std::filesystem::path shaderFolder();

} // namespace obscura
