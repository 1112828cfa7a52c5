#pragma once

#include "renderer/frame/light.h"
#include "renderer/frame/triangle_buffers.h"
#include "renderer/techniques/accumulation.h"
#include "renderer/techniques/further_layers.h"
#include "renderer/techniques/proxy_spheres.h"
#include "renderer/techniques/reduction.h"
#include "renderer/techniques/scene_occluders.h"
#include "renderer/techniques/settings.h"

#include <functional>
#include <optional>

namespace obscura {

// Pixels that the technique wants rendered beyond each border of an image (guardBand).
int guardPixels(const Settings& settings, int height);
// Bytes of GPU memory that the technique's passes write to for an image of this size.
double occlusionBytes(const Settings& settings, int width, int height);
// The technique works on every nth pixel across and down; this is n (the setting `downscale`, 1
// where it has none).
int downscaleOf(const Settings& settings);
// The technique shows a mean of so many frames (the setting `accumulate`, 1 where it has none).
int accumulatedFrames(const Settings& settings);

// The normals that a G-buffer must hold for a technique; none where it reads depth alone.
std::optional<Normals> normalsFor(const Technique& technique, Normals kind);

// What techniques may read of a view. The passes ask for what the technique's row names and for
// nothing else, so that what few read can be made when it is first asked for.
struct OcclusionInputs {
    struct Light {
        const LightBuffers& buffers;
        const Lighting& lighting;
    };

    const GBuffer& gbuffer;
    Frame frame; // the one that is bound
    std::function<Light()> light = {};
    std::function<const ProxySpheres&()> spheres = {};
    Peel peel = {};
    const SceneOccluders* occluders = nullptr; // makes of them what is asked for, then
    std::function<const TriangleBuffers&()> tree = {};
    // Visibility within a radius (metres) by so many rays a pixel, in red, as large as the
    // G-buffer; good until the next call (renderer/reference/few_rays.h).
    std::function<const gl::Texture&(const GBuffer&, const Frame&, float radius, int rays)> traced =
        {};
};

// Called after each pass has been issued, for timing and counting. The textures that the pass read
// and those that it wrote are still bound then.
using PassObserver = std::function<void(const Pass&)>;

// Runs a pass's program over level 0 of a target, in all layers. What it reads must be bound.
void drawPass(const Pass& pass, const gl::Program& program, const gl::SlicedTarget& target,
              const gl::ScreenTriangle& triangle, const OcclusionInputs& inputs);

// A technique's passes over a G-buffer of one size: they read depth and whatever else the technique
// asks for, and give visibility.
class OcclusionPasses {
  public:
    OcclusionPasses(const Settings& settings, int width, int height);

    // Uses other values from now on without compiling anything. Whole-number settings must stay the
    // same, because they are constants of the shaders.
    void set(const Settings& settings);

    // From now on images of this size, without compiling anything. What passes gave is lost.
    void resize(int width, int height);

    // A still picture's visibility in red, 1 open, 0 blocked; empty pixels are open. The frame must
    // be bound. What the technique accumulates is frames of this view alone, as many as it says.
    // The texture lives as long as this object, and has this content until the next call.
    const gl::Texture& visibility(const OcclusionInputs& inputs) const;
    // The same of the next frame of a moving picture: what the technique accumulates goes on from
    // the frame before, which the last call was for, until it is made to forget. Another size or
    // other settings make it forget too.
    const gl::Texture& next(const OcclusionInputs& inputs, const PassObserver& issued = {}) const;
    void forget() const;
    // Whether that texture's other channels are light to add (technique.h).
    bool sendsLight() const;

    // What a pass gave in the last run, for tests and for looking at.
    const gl::SlicedTarget& result(std::string_view pass) const;

  private:
    struct Step {
        const Pass* pass;
        gl::Program program;
        std::optional<gl::Program> levelProgram;
        gl::SlicedTarget target;
        int unit; // the texture unit from which later passes read it
    };
    void drawLayers(const OcclusionInputs& inputs) const;
    void bindInputs(const OcclusionInputs& inputs) const;
    void run(const Step& step, const OcclusionInputs& inputs) const;

    const gl::Texture& oneFrame(const OcclusionInputs& inputs, const PassObserver& issued) const;

    mutable std::optional<Reduction> reduction_; // keeps its frame
    FurtherLayers layers_;
    mutable std::optional<Accumulation> accumulation_;
    mutable std::optional<gl::UniformBuffer> cycledFrame_;
    std::vector<Step> steps_;
    Settings settings_;
    gl::UniformBuffer block_;
    std::optional<gl::UniformBuffer> points_;
    gl::Texture open_; // what a technique without passes shows
    gl::ScreenTriangle triangle_;
};

} // namespace obscura
