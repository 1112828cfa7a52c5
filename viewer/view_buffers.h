#pragma once

#include "renderer/probe.h"
#include "viewer/picture.h"

#include <array>
#include <map>
#include <optional>
#include <string>

namespace obscura {

// What all panes share of a view: its G-buffer, wider ones for techniques that want pixels beyond
// the border, and light. All is kept for as long as it is what is wanted.
class ViewBuffers {
  public:
    // The subject must outlive the buffers.
    explicit ViewBuffers(const Subject& subject) : subject_(subject) {}

    // A G-buffer, and the frame that it was drawn with.
    struct Sight {
        Frame frame;
        gl::UniformBuffer block;
        GBuffer gbuffer;
        bool white;            // the albedo, instead of the scene's
        bool sharp;            // textures (GpuScene::sharpen); else a sharp one may take its place
        std::uint64_t view;    // what was seen when it was drawn
        std::uint64_t version; // another number, another content
    };

    // What light there is from now on. A level like the last takes no time; else shadows are drawn,
    // and an Error (an environment that cannot be read) leaves the light that there was.
    bool isLit(const Level& level) const; // by this already
    void light(const Level& level);

    // What is seen from now on. True where that is not what was seen before: camera, size, normals.
    bool see(const Wanted& wanted);

    // Draw what a wish needs, where it is not there: false for nothing done. Light needs a level,
    // and a G-buffer that was drawn `lit`.
    bool drawGBuffer(const Wanted& wanted, bool lit, bool sharp);
    bool drawPadded(const Wanted& wanted, const Settings& settings);
    bool drawLight();

    void forget(); // all is drawn anew when it is wanted next

    const Sight& sight(int guard = 0) const { return sights_.at(guard); } // drawn before
    const LightBuffers& lightBuffers() const { return *light_; }          // drawn before
    const Lighting& lighting() const { return *lighting_; }
    std::uint64_t lightVersion() const { return lightVersion_; } // another number, another content
    // The lowest and highest depth of the scene's box in this view, from the near plane on.
    std::array<double, 2> depthRange() const;

  private:
    bool draw(int guard, const GBufferContent& content, bool white, bool sharp);

    const Subject& subject_;
    std::string level_, seen_; // texts of what `lighting_` and the view were made from
    Camera camera_;
    int width_ = 0, height_ = 0;
    std::uint64_t view_ = 0;      // counts what was seen
    std::map<int, Sight> sights_; // by guard pixels
    std::uint64_t drawn_ = 0;     // counts G-buffers
    std::optional<Lighting> lighting_;
    std::uint64_t lighted_ = 0; // counts levels
    std::optional<LightBuffers> light_;
    std::uint64_t lightVersion_ = 0;
    std::array<std::uint64_t, 2> litFrom_{}; // the G-buffer and level that the light is of
};

} // namespace obscura
