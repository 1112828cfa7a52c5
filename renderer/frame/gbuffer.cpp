#include "renderer/frame/gbuffer.h"

#include "base/shipped.h"
#include "renderer/frame/vec3.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

// A depth beyond every corner of the scene, so that no surface is taken for an empty pixel.
double emptyDepth(const glm::dmat4& viewFromWorld, const Bounds& bounds, double near) {
    double farthest = near;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 position(corner & 1 ? bounds.high.x : bounds.low.x,
                                  corner & 2 ? bounds.high.y : bounds.low.y,
                                  corner & 4 ? bounds.high.z : bounds.low.z);
        farthest = std::max(farthest, -(viewFromWorld * glm::dvec4(position, 1)).z);
    }
    return farthest * 1.01 + near;
}

std::span<const std::byte> bytesOf(const std::vector<Vertex>& vertices) {
    return std::as_bytes(std::span(vertices));
}

// The scene's and OpenGL's names for the same thing.
static_assert(static_cast<int>(Wrap::repeat) == static_cast<int>(gl::Wrap::repeat) &&
              static_cast<int>(Wrap::mirrored) == static_cast<int>(gl::Wrap::mirrored) &&
              static_cast<int>(Wrap::clamp) == static_cast<int>(gl::Wrap::clamp) &&
              static_cast<int>(Minified::linear) == static_cast<int>(gl::Minified::linear) &&
              static_cast<int>(Minified::linearMipmapLinear) ==
                  static_cast<int>(gl::Minified::linearMipmapLinear));

// Those of shaders/material.glsl, by their bindings: base colour; normal, metallic and roughness;
// emission.
int mapsOf(GpuScene::Reads reads) {
    return reads == GpuScene::Reads::forDepth ? 1 : reads == GpuScene::Reads::withEmission ? 4 : 3;
}

void addFrameBlock(gl::ShaderText& text) {
    text.addFile(shaderFolder(), "frame.h");
    text.add("layout(std140, binding = 0) uniform FrameBlock { Frame frame; };", "(frame block)");
}

} // namespace

double nearPlane(const Camera& camera, const Bounds& bounds) {
    const auto diagonal = static_cast<double>(glm::distance(bounds.low, bounds.high));
    return camera.near > 0 ? camera.near : std::clamp(diagonal / 20, 1e-6, 0.05);
}

Frame makeFrame(const Camera& camera, int width, int height, const Bounds& bounds,
                std::uint64_t seed, glm::vec2 jitter, int guard) {
    if (const std::string fault = faultOf(camera); !fault.empty())
        throw Error(fault);
    const glm::dmat4 viewFromWorld =
        glm::lookAt(vec(camera.position), vec(camera.target), vec(camera.up));
    const int inner = height;
    width += 2 * guard;
    height += 2 * guard;
    const double scaleY = inner / std::tan(glm::radians(camera.fovDegrees) / 2) / height;
    const double scaleX = scaleY * height / width;
    const double shiftX = 2.0 * static_cast<double>(jitter.x) / width;
    const double shiftY = 2.0 * static_cast<double>(jitter.y) / height;

    // Reversed depth with no far plane: z_clip = near, w = -z_view.
    glm::dmat4 clipFromView(0);
    clipFromView[0][0] = scaleX;
    clipFromView[1][1] = scaleY;
    clipFromView[2] = {-shiftX, -shiftY, 0, -1};
    const double near = nearPlane(camera, bounds);
    clipFromView[3][2] = near;

    Frame frame;
    frame.viewFromWorld = glm::mat4(viewFromWorld);
    frame.worldFromView = glm::mat4(glm::inverse(viewFromWorld));
    frame.clipFromView = glm::mat4(clipFromView);
    frame.viewFromUv =
        glm::vec4(2 / scaleX, 2 / scaleY, (-1 - shiftX) / scaleX, (-1 - shiftY) / scaleY);
    frame.size = glm::vec4(width, height, 1.0 / width, 1.0 / height);
    const double focus = glm::distance(vec(camera.position), vec(camera.target));
    frame.depth = glm::vec4(near, emptyDepth(viewFromWorld, bounds, near), focus, scaleY / 2);
    frame.depthStep = glm::vec4(std::numeric_limits<float>::epsilon(), 0, 0, 0); // GBuffer::depth()
    frame.seed = glm::ivec4(static_cast<int>(seed & 0x7fffffff), 0, 0, 0);
    return frame;
}

namespace {

MaterialFeatures featuresOf(const Scene& scene, const Mesh& mesh) {
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    MaterialFeatures result;
    result.masked = material.alphaCutoff > 0;
    for (const TextureUse& use : {material.baseColourTexture, material.normalTexture,
                                  material.metallicRoughnessTexture, material.emissionTexture})
        result.transformed |= use.exists() && !use.plain();
    const auto first = scene.indices.begin() + mesh.firstIndex;
    result.coloured = std::any_of(first, first + mesh.indexCount, [&](std::uint32_t index) {
        return scene.vertices[index].colour != glm::vec4(1);
    });
    result.glossiness = material.specularGlossiness.has_value();
    return result;
}

} // namespace

GpuScene::GpuScene(const Scene& scene)
    : bounds_(scene.bounds()), meshes_(scene.meshes), materials_(scene.materials),
      lights_(scene.lights),
      geometry_(bytesOf(scene.vertices), std::array{3, 3, 4, 2, 2, 4}, scene.indices),
      white_(gl::constantTexture({1, 1, 1, 1})) {
    for (const Texture& texture : scene.textures) {
        const gl::Sampling sampling{static_cast<gl::Wrap>(texture.wrapU),
                                    static_cast<gl::Wrap>(texture.wrapV), texture.nearest,
                                    static_cast<gl::Minified>(texture.minified)};
        if (gl::isAnisotropic(texture.srgb, sampling))
            anisotropic_.push_back(textures_.size());
        textures_.push_back(gl::imageTexture(texture.image.width, texture.image.height,
                                             texture.srgb, texture.image.pixels, sampling));
    }
    for (const Mesh& mesh : meshes_) {
        pieces_.push_back(piecesOf(scene, mesh));
        features_.push_back(featuresOf(scene, mesh));
        kinds_.insert(features_.back());
        emits_ = emits_ || materials_[static_cast<std::size_t>(mesh.material)].emits();
    }
}

void GpuScene::sharpen(bool sharp) const {
    if (std::exchange(sharp_, sharp) != sharp)
        for (const std::size_t each : anisotropic_)
            gl::filterAnisotropically(textures_[each], sharp);
}

const gl::Texture& GpuScene::texture(const TextureUse& use) const {
    return use.exists() ? textures_[static_cast<std::size_t>(use.texture)] : white_;
}

namespace {

void set(const gl::Program& program, const char* name, const glm::vec4& value) {
    program.set(name, std::span<const float, 4>(glm::value_ptr(value), 4));
}

void setTransform(const gl::Program& program, int map, const TextureUse& use) {
    const glm::mat2 m = use.matrix();
    const glm::vec3 offset(use.offset, use.set);
    set(program, fmt::format("mapMatrix[{}]", map).c_str(), {m[0], m[1]});
    program.set(fmt::format("mapOffset[{}]", map).c_str(),
                std::span<const float, 3>(glm::value_ptr(offset), 3));
}

} // namespace

void GpuScene::bindMaterial(const gl::Program& program, const Material& material,
                            const MaterialFeatures& features, Reads reads) const {
    const TextureUse* maps[] = {&material.baseColourTexture, &material.normalTexture,
                                &material.metallicRoughnessTexture, &material.emissionTexture};
    for (int map = 0; map < mapsOf(reads); ++map) {
        gl::bindTexture(map, texture(*maps[map]));
        if (features.transformed)
            setTransform(program, map, *maps[map]);
    }
    set(program, "baseColour", material.baseColour);
    set(program, "surface",
        {material.alphaCutoff, material.metallic, material.roughness,
         material.normalTexture.exists() ? material.normalScale : 0.0f});
    if (reads == Reads::forDepth)
        return;
    if (const auto& glossy = material.specularGlossiness)
        set(program, "specularGlossiness", {glossy->specular, glossy->glossiness});
    if (reads == Reads::withEmission)
        set(program, "emission", {material.emission, material.unlit ? 1 : 0});
}

// Software rasterisers take as long for a vertex that is not seen as for one that is.
std::vector<GpuScene::Piece> GpuScene::piecesOf(const Scene& scene, const Mesh& mesh) {
    constexpr std::uint32_t most = 3 * 256; // indices
    std::vector<Piece> pieces;
    for (std::uint32_t first = 0; first < mesh.indexCount; first += most) {
        const std::uint32_t count = std::min(most, mesh.indexCount - first);
        Piece piece{mesh.firstIndex + first, count, {}};
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec3 place = scene.vertices[scene.indices[piece.firstIndex + i]].position;
            piece.bounds.low = i == 0 ? place : glm::min(piece.bounds.low, place);
            piece.bounds.high = i == 0 ? place : glm::max(piece.bounds.high, place);
        }
        pieces.push_back(piece);
    }
    return pieces;
}

namespace {

// Whether a box lies beyond one of the picture's borders, or before the near plane (or the sun's
// far one) as a whole; with room for rounding.
bool isOutside(const Bounds& box, const glm::mat4& clipFromWorld) {
    const glm::mat4 rows = glm::transpose(clipFromWorld);
    const glm::vec4 borders[] = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                 rows[3] - rows[1], rows[3] - rows[2]};
    return std::any_of(std::begin(borders), std::end(borders), [&](const glm::vec4& border) {
        float most = border.w, size = std::abs(border.w);
        for (int axis = 0; axis < 3; ++axis) {
            const float low = border[axis] * box.low[axis], high = border[axis] * box.high[axis];
            most += std::max(low, high);
            size += std::max(std::abs(low), std::abs(high));
        }
        return most < -1e-5f * size;
    });
}

} // namespace

std::vector<Mesh> GpuScene::seen(std::size_t index, const glm::mat4& clipFromWorld) const {
    std::vector<Mesh> runs;
    for (const Piece& piece : pieces_[index]) {
        if (isOutside(piece.bounds, clipFromWorld))
            continue;
        if (runs.empty() || runs.back().firstIndex + runs.back().indexCount != piece.firstIndex)
            runs.push_back({piece.firstIndex, 0, meshes_[index].material});
        runs.back().indexCount += piece.indexCount;
    }
    return runs;
}

void GpuScene::drawMesh(std::size_t index, std::span<const Mesh> seen, bool cullBackFaces,
                        gl::State& state) const {
    const int material = meshes_[index].material;
    state.cullBack = cullBackFaces && !materials_[static_cast<std::size_t>(material)].doubleSided;
    state.apply();
    for (const Mesh& run : seen)
        geometry_.draw(run.firstIndex, run.indexCount);
}

void GpuScene::draw(const gl::Program& program, const glm::mat4& clipFromWorld,
                    const MaterialFeatures& features, Reads reads, bool cullBackFaces,
                    gl::State state) const {
    program.use();
    geometry_.bind();
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        if (features_[i] != features)
            continue;
        const std::vector<Mesh> runs = seen(i, clipFromWorld);
        if (runs.empty())
            continue;
        bindMaterial(program, materials_[static_cast<std::size_t>(meshes_[i].material)], features,
                     reads);
        drawMesh(i, runs, cullBackFaces, state);
    }
}

void GpuScene::drawOpaque(const gl::Program& program, const glm::mat4& clipFromWorld,
                          bool cullBackFaces, gl::State state) const {
    program.use();
    geometry_.bind();
    for (std::size_t i = 0; i < meshes_.size(); ++i)
        if (!features_[i].masked)
            drawMesh(i, seen(i, clipFromWorld), cullBackFaces, state);
}

namespace {

gl::ShaderText materialShader(const std::string& name, const MaterialFeatures& features,
                              GpuScene::Reads reads, bool peels = false) {
    gl::ShaderText text;
    text.add(fmt::format("#define MASKED {:d}\n#define TRANSFORMED {:d}\n#define COLOURED {:d}\n"
                         "#define GLOSSINESS {:d}\n#define EMISSION {:d}\n#define MAPS {}\n"
                         "#define PEELED {:d}\n",
                         features.masked, features.transformed, features.coloured,
                         features.glossiness, reads == GpuScene::Reads::withEmission, mapsOf(reads),
                         peels),
             "(variant)");
    addFrameBlock(text);
    text.addFile(shaderFolder(), name);
    return text;
}

gl::Program materialProgram(const std::string& label, const std::string& vertex,
                            const std::string& fragment, const MaterialFeatures& features,
                            GpuScene::Reads reads, bool peels = false) {
    return gl::Program(label, materialShader(vertex, features, reads, peels),
                       materialShader(fragment, features, reads, peels));
}

} // namespace

std::string gbufferShaders() {
    std::string texts;
    for (const char* name : {"depth_only.vert", "depth_only.frag", "gbuffer.vert", "gbuffer.frag"})
        texts +=
            materialShader(name, {true, true, true, true}, GpuScene::Reads::withEmission).text();
    return texts;
}

DepthPass::DepthPass(bool peels)
    : peels_(peels),
      opaque_(materialProgram("depth of opaque", "depth_only.vert", "depth_only.frag", {},
                              GpuScene::Reads::forDepth, peels)) {}

const gl::Program& DepthPass::masked(const MaterialFeatures& features) const {
    const MaterialFeatures alpha{true, features.transformed, features.coloured, false};
    const auto known = masked_.find(alpha);
    return known != masked_.end()
               ? known->second
               : masked_
                     .emplace(alpha, materialProgram("depth of masked", "depth_only.vert",
                                                     "depth_only.frag", alpha,
                                                     GpuScene::Reads::forDepth, peels_))
                     .first->second;
}

void DepthPass::draw(const GpuScene& scene, const glm::mat4& clipFromWorld, bool cullBackFaces,
                     const gl::State& state, float separation) const {
    const auto see = [&](const gl::Program& program) -> const gl::Program& {
        if (peels_)
            program.set("separation", separation);
        program.setMatrix("clipFromWorld",
                          std::span<const float, 16>(glm::value_ptr(clipFromWorld), 16));
        return program;
    };
    scene.drawOpaque(see(opaque_), clipFromWorld, cullBackFaces, state);
    for (const MaterialFeatures& features : scene.features())
        if (features.masked)
            scene.draw(see(masked(features)), clipFromWorld, features, GpuScene::Reads::forDepth,
                       cullBackFaces, state);
}

namespace {

std::vector<gl::Format> gbufferFormats(const GBufferContent& content) {
    using gl::Format;
    const bool mapped = content.occlusionNormal == Normals::mapped;
    std::vector<Format> formats{content.albedo ? Format::srgb8 : Format::none, Format::r32f,
                                content.shadingNormal || mapped ? Format::rgba16f : Format::none,
                                content.occlusionNormal && !mapped ? Format::rgba16f : Format::none,
                                content.emission ? Format::rgba16f : Format::none};
    while (formats.back() == Format::none)
        formats.pop_back();
    return formats;
}

} // namespace

GBuffer::GBuffer(int width, int height, GBufferContent content)
    : content_(content), target_(width, height, gbufferFormats(content), true, "G-buffer") {}

const gl::Texture* GBuffer::shadingNormal() const {
    return target_.has(2) ? &target_.colour(2) : nullptr;
}

const gl::Texture* GBuffer::occlusionNormal() const {
    if (!content_.occlusionNormal)
        return nullptr;
    return &target_.colour(*content_.occlusionNormal == Normals::mapped ? 2 : 3);
}

const gl::Texture* GBuffer::emission() const {
    return target_.has(4) ? &target_.colour(4) : nullptr;
}

gl::UniformBuffer frameBuffer(const Frame& frame) {
    return gl::UniformBuffer(std::as_bytes(std::span(&frame, 1)));
}

void bindFrame(const gl::UniformBuffer& frame) { frame.bind(0); }

// The plain one at once, for most scenes need no other.
GBufferPass::GBufferPass() { program({}, false); }

const gl::Program& GBufferPass::program(const MaterialFeatures& features, bool emission) const {
    const std::pair key(
        MaterialFeatures{false, features.transformed, features.coloured, features.glossiness},
        emission);
    const auto known = programs_.find(key);
    return known != programs_.end()
               ? known->second
               : programs_
                     .emplace(key,
                              materialProgram("G-buffer", "gbuffer.vert", "gbuffer.frag", key.first,
                                              emission ? GpuScene::Reads::withEmission
                                                       : GpuScene::Reads::withoutEmission))
                     .first->second;
}

void GBufferPass::draw(const GpuScene& scene, const Frame& frame, const GBuffer& gbuffer) const {
    const gl::Target& target = gbuffer.target();
    target.bind();
    gl::State{}.apply();
    const std::array<float, 4> empty[] = {
        {0, 0, 0, 0}, {frame.depth.y, 0, 0, 0}, {0, 0, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 0}};
    for (int i = 0; i < target.count(); ++i)
        if (target.has(i))
            target.clear(i, empty[i]);
    gl::State state;
    state.depth = gl::State::Depth::reversed;
    state.colour = false;
    state.apply();
    target.clearDepth(0);
    const glm::mat4 clipFromWorld = frame.clipFromView * frame.viewFromWorld;
    depth_.draw(scene, clipFromWorld, true, state);
    state.depth = gl::State::Depth::equal;
    state.colour = true;
    const bool emission = gbuffer.content().emission;
    for (const MaterialFeatures& features : scene.features()) {
        const gl::Program& drawn = program(features, emission);
        drawn.set("faceNormals", gbuffer.content().occlusionNormal == Normals::face ? 1 : 0);
        drawn.setMatrix("clipFromWorld",
                        std::span<const float, 16>(glm::value_ptr(clipFromWorld), 16));
        scene.draw(drawn, clipFromWorld, features,
                   emission ? GpuScene::Reads::withEmission : GpuScene::Reads::withoutEmission,
                   true, state);
    }
}

void GBufferPass::peel(const GpuScene& scene, const Frame& frame, const gl::Texture& before,
                       float separation, const gl::Target& layer) const {
    if (!peel_)
        peel_.emplace(true);
    layer.bind();
    gl::State state;
    state.depth = gl::State::Depth::reversed;
    state.apply();
    layer.clear(0, {frame.depth.y, 0, 0, 0});
    layer.clearDepth(0);
    gl::bindTexture(DepthPass::beforeUnit, before);
    peel_->draw(scene, frame.clipFromView * frame.viewFromWorld, true, state, separation);
}

std::filesystem::path shaderFolder() { return shipped("shaders"); }

gl::ShaderText shaderText(const std::string& name) {
    gl::ShaderText text;
    addFrameBlock(text);
    text.addFile(shaderFolder(), name);
    return text;
}

} // namespace obscura
