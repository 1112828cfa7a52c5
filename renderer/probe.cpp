#include "renderer/probe.h"

#include "gl/context.h"

namespace obscura {

namespace {

Level whiteLight() {
    Level level;
    level.ambient = Vec3{1, 1, 1};
    return level;
}

// What decides where a ray is blocked: triangles, and the pictures in which masked materials have
// their holes.
Scene geometryOf(const Scene& scene) {
    Scene result;
    result.vertices = scene.vertices;
    result.indices = scene.indices;
    result.meshes = scene.meshes;
    result.materials = scene.materials;
    result.textures.resize(scene.textures.size());
    for (const Material& material : scene.materials)
        if (const TextureUse& use = material.baseColourTexture;
            material.alphaCutoff > 0 && use.exists())
            result.textures[static_cast<std::size_t>(use.texture)] =
                scene.textures[static_cast<std::size_t>(use.texture)];
    return result;
}

// Empty pixels, which hold `empty`, stay so.
void store(const Probe::StoredDepth& storedDepth, float empty, const GBuffer& gbuffer) {
    const int width = gbuffer.target().width(), height = gbuffer.target().height();
    std::vector<float> depth = gl::readFloats(gbuffer.depth(), width, height, gl::Format::r32f);
    for (float& value : depth)
        value = value < empty ? storedDepth.of(value) : value;
    gl::writeFloats(gbuffer.depth(), width, height, depth);
}

} // namespace

// What a technique sees, with or without a guard band around the image.
struct Probe::Sight {
    Frame frame;
    gl::UniformBuffer frameBlock;
    GBuffer gbuffer;
    mutable std::optional<LightBuffers> light; // once a technique has read it
};

Subject::Subject(const Scene& scene)
    : Subject(scene, std::make_shared<const Scene>(geometryOf(scene))) {}

Subject::Subject(const Scene& scene, std::shared_ptr<const Scene> geometry)
    : spheres_(geometry), occluders_(scene), triangles_(geometry), traced_(geometry), scene_(scene),
      lighting_(whiteLight(), scene_, std::filesystem::path()) {}

Probe::Probe(const Subject& subject, const Camera& camera, int width, int height, Normals kind,
             std::uint64_t seed, StoredDepth storedDepth)
    : subject_(subject), camera_(camera), width_(width), height_(height), kind_(kind), seed_(seed),
      storedDepth_(std::move(storedDepth)),
      surfaces_(surfacesOf(subject.scene(), subject.pass(),
                           makeFrame(camera, width, height, subject.scene().bounds(), seed),
                           kind)) {
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x)
            shown_.push_back(!surfaces_.empty(surfaces_.index(x, y)));
}

Probe::~Probe() = default;
Probe::Probe(Probe&&) noexcept = default;

const Probe::Sight& Probe::sight(int guard) const {
    std::unique_ptr<Sight>& known = sights_[guard];
    if (!known) {
        const int width = width_ + 2 * guard, height = height_ + 2 * guard;
        Frame frame =
            makeFrame(camera_, width_, height_, subject_.scene().bounds(), seed_, {0, 0}, guard);
        if (storedDepth_.of)
            frame.depthStep = glm::vec4(storedDepth_.step, 0, 0);
        known.reset(
            new Sight{frame, frameBuffer(frame), GBuffer(width, height, {true, false, kind_}), {}});
        draw(*known);
        if (storedDepth_.of)
            store(storedDepth_, frame.depth.y, known->gbuffer);
    }
    return *known;
}

void Probe::draw(const Sight& sight) const {
    bindFrame(sight.frameBlock);
    subject_.pass().draw(subject_.scene(), sight.frame, sight.gbuffer);
}

void Probe::drawGBuffer() const { draw(sight(0)); }

OcclusionPasses Probe::passesFor(const Settings& settings, int beyond) const {
    const int guard = guardPixels(settings, height_) + beyond;
    return OcclusionPasses(settings, width_ + 2 * guard, height_ + 2 * guard);
}

const gl::Texture& Probe::run(const Settings& settings, const OcclusionPasses& passes, int beyond,
                              const PassObserver& issued) const {
    const Sight& seen = sight(guardPixels(settings, height_) + beyond);
    const auto light = [&]() -> OcclusionInputs::Light {
        if (!seen.light) {
            seen.light.emplace(seen.gbuffer.target().width(), seen.gbuffer.target().height(),
                               false);
            subject_.lighting().draw(seen.gbuffer, *seen.light);
        }
        return {*seen.light, subject_.lighting()};
    };
    bindFrame(seen.frameBlock);
    return passes.next({seen.gbuffer, seen.frame, light, std::cref(subject_.spheres()),
                        subject_.peel(), &subject_.occluders(), std::cref(subject_.triangles()),
                        std::cref(subject_.traced())},
                       issued);
}

Image Probe::visibility(const Settings& settings) const {
    OcclusionPasses passes = passesFor(settings);
    return visibility(settings, passes);
}

Image Probe::visibility(const Settings& settings, OcclusionPasses& passes, int beyond) const {
    passes.set(settings);
    passes.forget();
    for (int frame = 1; frame < accumulatedFrames(settings); ++frame)
        run(settings, passes, beyond);
    return next(settings, passes, beyond);
}

Image Probe::next(const Settings& settings, OcclusionPasses& passes, int beyond) const {
    Image image{width_, height_, 1, {}};
    if (settings.technique().passes.empty()) {
        image.pixels.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                            1.0f);
        return image;
    }
    const int guard = guardPixels(settings, height_) + beyond, width = width_ + 2 * guard;
    passes.set(settings);
    const std::vector<float> values =
        gl::readFloats(run(settings, passes, beyond), width, height_ + 2 * guard, gl::Format::r32f);
    for (int y = guard + height_ - 1; y >= guard; --y) {
        const auto row = values.begin() + y * width + guard;
        image.pixels.insert(image.pixels.end(), row, row + width_);
    }
    gl::throwMessages();
    return image;
}

} // namespace obscura
