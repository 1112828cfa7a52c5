#pragma once

#include "renderer/frame/light.h"

namespace obscura {

// Puts an image together: ambient light x visibility + direct light + emission, exposure, display
// curve. Each
// draw() adds a jittered frame; mean() is their average. Averaging follows the display curve, as
// the eye averages what a display shows; only then edges next to very bright light are smooth.
class Composite {
  public:
    // `linear` keeps the average before the display curve too.
    Composite(const View& view, const Level& level, int width, int height, bool linear);

    // The visibility buffer is `guard` pixels wider than the image on every side; with `sendsLight`
    // its other channels are light to add (renderer/techniques/technique.h). `emission` is what
    // surfaces send by themselves, GBuffer::emission(): nothing occludes it.
    void draw(const LightBuffers& light, const gl::Texture& visibility, bool sendsLight = false,
              int guard = 0, const gl::Texture* emission = nullptr);

    void restart(); // forgets all frames drawn so far
    // What is drawn from now on is exposed and curved so; nothing is compiled.
    void set(const View& view, const Level& level);

    // Of all frames: red, green, blue (display-linear) and visibility, as mean() has them for one.
    const gl::Texture& sum() const { return sum_.colour(0); }

    // Red, green, blue (display-linear, 0 ... 1) and visibility; rows from the bottom.
    std::vector<float> mean() const { return mean(0); }
    // Scene-linear red, green, blue, times 2^exposure; the fourth is 1.
    std::vector<float> meanLinear() const { return mean(1); }

  private:
    std::vector<float> mean(int colour) const;

    gl::Program program_;
    gl::Target sum_;
    gl::ScreenTriangle triangle_;
    int frames_ = 0;
};

// The assembled text of the shader, for recipes.
gl::ShaderText compositeShader();

} // namespace obscura
