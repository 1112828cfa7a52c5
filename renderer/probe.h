#pragma once

#include "renderer/frame/surfaces.h"
#include "renderer/reference/few_rays.h"
#include "renderer/reference/triangle_tree.h"
#include "renderer/techniques/occlusion_passes.h"

#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace obscura {

// A scene with all that techniques may read of it, whatever the camera; what few read is made when
// first asked for. Its light is constant and white, so that those which read light see only
// geometry.
class Subject {
  public:
    explicit Subject(const Scene& scene);

    const GpuScene& scene() const { return scene_; }
    const GBufferPass& pass() const { return pass_; }
    const Lighting& lighting() const { return lighting_; }
    const SceneSpheres& spheres() const { return spheres_; }
    Peel peel() const { return peelOf(pass_, scene_); }
    const SceneOccluders& occluders() const { return occluders_; }
    const SceneTriangles& triangles() const { return triangles_; }
    const FewRays& traced() const { return traced_; }

  private:
    // `geometry`: what of a scene is kept, without the textures that are on the GPU.
    Subject(const Scene& scene, std::shared_ptr<const Scene> geometry);

    SceneSpheres spheres_;
    SceneOccluders occluders_;
    SceneTriangles triangles_;
    FewRays traced_;
    GpuScene scene_;
    GBufferPass pass_;
    Lighting lighting_;
};

// One view of a subject, drawn once, to run techniques on again and again; what matching and
// benches measure with. Without anti-aliasing: a pixel is the surface point at its centre.
class Probe {
  public:
    // What becomes of a view depth (metres) in the buffer that techniques read, for example when it
    // has fewer bits, and how far apart such depths are (Frame::depthStep). surfaces() keep the
    // true one.
    struct StoredDepth {
        std::function<float(float)> of;
        glm::vec2 step;
    };

    // The subject must outlive the probe.
    Probe(const Subject& subject, const Camera& camera, int width, int height, Normals kind,
          std::uint64_t seed, StoredDepth storedDepth = {});
    ~Probe();
    Probe(Probe&&) noexcept;

    // Visibility as the technique's last pass leaves it: 1 channel, top row first. The passes,
    // those of passesFor() of like settings (OcclusionPasses::set) and the same `beyond`, may be
    // shared by probes of one size. They see `beyond` more pixels past each border than the
    // technique asks for.
    Image visibility(const Settings& settings) const;
    Image visibility(const Settings& settings, OcclusionPasses& passes, int beyond = 0) const;
    OcclusionPasses passesFor(const Settings& settings, int beyond = 0) const;

    // The same of the next frame of a moving picture, which goes on from the passes' frame before
    // (OcclusionPasses::next).
    Image next(const Settings& settings, OcclusionPasses& passes, int beyond = 0) const;

    // The next frame without fetching the picture: what there is to time.
    const gl::Texture& run(const Settings& settings, const OcclusionPasses& passes, int beyond = 0,
                           const PassObserver& issued = {}) const;
    void drawGBuffer() const; // draws the G-buffer again, to be timed

    int width() const { return width_; }
    int height() const { return height_; }
    // For references to trace from.
    const Surfaces& surfaces() const { return surfaces_; }
    // Where a surface shows, rows as in visibility(): others are open by definition, and no error
    // is measured there.
    const std::vector<bool>& shown() const { return shown_; }

  private:
    struct Sight;
    const Sight& sight(int guard) const;
    void draw(const Sight& sight) const;

    const Subject& subject_;
    Camera camera_;
    int width_, height_;
    Normals kind_;
    std::uint64_t seed_;
    StoredDepth storedDepth_;
    Surfaces surfaces_;
    std::vector<bool> shown_;
    mutable std::map<int, std::unique_ptr<Sight>>
        sights_; // by guard pixels, drawn when first asked
};

} // namespace obscura
