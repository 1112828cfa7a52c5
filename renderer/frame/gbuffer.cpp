#include "renderer/frame/gbuffer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace obscura {

namespace {

glm::dvec3 vec(const Vec3& v) { return {v[0], v[1], v[2]}; }

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
              static_cast<int>(Wrap::clamp) == static_cast<int>(gl::Wrap::clamp));

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
    frame.seed = glm::ivec4(static_cast<int>(seed & 0x7fffffff), 0, 0, 0);
    return frame;
}

GpuScene::GpuScene(const Scene& scene)
    : bounds_(scene.bounds()), meshes_(scene.meshes), materials_(scene.materials),
      geometry_(bytesOf(scene.vertices), std::array{3, 3, 4, 2, 2, 4}, scene.indices),
      white_(gl::constantTexture({1, 1, 1, 1})) {
    for (const Texture& texture : scene.textures)
        textures_.push_back(gl::imageTexture(
            texture.image.width, texture.image.height, texture.srgb, texture.image.pixels,
            {static_cast<gl::Wrap>(texture.wrapU), static_cast<gl::Wrap>(texture.wrapV),
             texture.nearest}));
}

const gl::Texture& GpuScene::texture(int index) const {
    return index < 0 ? white_ : textures_[static_cast<std::size_t>(index)];
}

void GpuScene::bindMaterial(const gl::Program& program, const Material& material) const {
    gl::bindTexture(0, texture(material.baseColourTexture));
    gl::bindTexture(1, texture(material.normalTexture));
    gl::bindTexture(2, texture(material.metallicRoughnessTexture));
    program.set("baseColour", std::span<const float, 4>(glm::value_ptr(material.baseColour), 4));
    const float surface[4] = {material.alphaCutoff, material.metallic, material.roughness,
                              material.normalTexture < 0 ? 0.0f : material.normalScale};
    program.set("surface", std::span<const float, 4>(surface));
}

void GpuScene::draw(const gl::Program& program, Take take, bool cullBackFaces,
                    gl::State state) const {
    program.use();
    geometry_.bind();
    for (const Mesh& mesh : meshes_) {
        const Material& material = materials_[static_cast<std::size_t>(mesh.material)];
        const bool masked = material.alphaCutoff > 0;
        if ((take == Take::opaque && masked) || (take == Take::masked && !masked))
            continue;
        state.cullBack = cullBackFaces && !material.doubleSided;
        state.apply();
        if (take != Take::opaque)
            bindMaterial(program, material);
        geometry_.draw(mesh.firstIndex, mesh.indexCount);
    }
}

gl::ShaderText DepthPass::fragmentShader(bool masked) {
    gl::ShaderText text;
    text.add(masked ? "#define MASKED 1" : "#define MASKED 0", "(variant)");
    text.addFile(shaderFolder(), "depth_only.frag");
    return text;
}

DepthPass::DepthPass()
    : opaque_("depth of opaque", shaderText("depth_only.vert"), fragmentShader(false)),
      masked_("depth of masked", shaderText("depth_only.vert"), fragmentShader(true)) {}

void DepthPass::draw(const GpuScene& scene, const glm::mat4& clipFromWorld, bool cullBackFaces,
                     const gl::State& state) const {
    for (const gl::Program* program : {&opaque_, &masked_}) {
        program->setMatrix("clipFromWorld",
                           std::span<const float, 16>(glm::value_ptr(clipFromWorld), 16));
        scene.draw(*program, program == &opaque_ ? GpuScene::Take::opaque : GpuScene::Take::masked,
                   cullBackFaces, state);
    }
}

namespace {

std::vector<gl::Format> gbufferFormats(const GBufferContent& content) {
    using gl::Format;
    const bool mapped = content.occlusionNormal == Normals::mapped;
    std::vector<Format> formats{content.albedo ? Format::srgb8 : Format::none, Format::r32f,
                                content.shadingNormal || mapped ? Format::rgba16f : Format::none,
                                content.occlusionNormal && !mapped ? Format::rgba16f
                                                                   : Format::none};
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

gl::UniformBuffer frameBuffer(const Frame& frame) {
    return gl::UniformBuffer(std::as_bytes(std::span(&frame, 1)));
}

void bindFrame(const gl::UniformBuffer& frame) { frame.bind(0); }

GBufferPass::GBufferPass()
    : program_("G-buffer", shaderText("gbuffer.vert"), shaderText("gbuffer.frag")) {}

void GBufferPass::draw(const GpuScene& scene, const Frame& frame, const GBuffer& gbuffer) const {
    const gl::Target& target = gbuffer.target();
    target.bind();
    gl::State{}.apply();
    const std::array<float, 4> empty[] = {
        {0, 0, 0, 0}, {frame.depth.y, 0, 0, 0}, {0, 0, 1, 1}, {0, 0, 1, 1}};
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
    program_.set("faceNormals", gbuffer.content().occlusionNormal == Normals::face ? 1 : 0);
    program_.setMatrix("clipFromWorld",
                       std::span<const float, 16>(glm::value_ptr(clipFromWorld), 16));
    scene.draw(program_, GpuScene::Take::all, true, state);
}

std::filesystem::path shaderFolder() {
    const char* folder = std::getenv("OBSCURA_SHADERS");
    return folder ? folder : OBSCURA_SHADERS;
}

gl::ShaderText shaderText(const std::string& name) {
    gl::ShaderText text;
    text.addFile(shaderFolder(), "frame.h");
    text.add("layout(std140, binding = 0) uniform FrameBlock { Frame frame; };", "(frame block)");
    text.addFile(shaderFolder(), name);
    return text;
}

} // namespace obscura
