#pragma once

#include "renderer/frame/gbuffer.h"
#include "viewer/picture.h"

#include <memory>
#include <optional>

namespace obscura {

// Makes pictures, and takes back those that nobody holds any more: on any thread, so that whoever
// shows one needs no context to drop it.
class PicturePool {
  public:
    PicturePool();
    ~PicturePool(); // with the context; what is still held stays until the context's group is gone
    PicturePool(const PicturePool&) = delete;
    PicturePool& operator=(const PicturePool&) = delete;

    // To be drawn into. Of those that came back it is the first that did, so that a driver which
    // still shows one has had the most time.
    std::shared_ptr<SharedPicture> take(int width, int height);

  private:
    struct Shelf;
    std::shared_ptr<Shelf> shelf_;
};

// Draws buffers as code values (shaders/show.frag). The frame must be bound.
class ShowPass {
  public:
    ShowPass();

    // A visibility buffer that is `guard` pixels wider than the picture on every side.
    struct Visibility {
        const gl::Texture& texture;
        int guard = 0;
    };

    void lit(const gl::Texture& displayLinear, const SharedPicture& into);
    void visibility(const Visibility& visibility, const SharedPicture& into);
    void albedo(const GBuffer& gbuffer, const SharedPicture& into);
    void normals(const GBuffer& gbuffer, const SharedPicture& into); // which must have them
    // Between these depths, metres.
    void depth(const GBuffer& gbuffer, double nearest, double farthest, const SharedPicture& into);
    void error(const Visibility& visibility, const gl::Texture& reference, const GBuffer& gbuffer,
               double scale, const SharedPicture& into);
    void jod(const gl::Texture& map, const SharedPicture& into);
    void difference(const Visibility& first, const Visibility& second, const GBuffer& gbuffer,
                    double scale, const SharedPicture& into);
    // Of what two pictures show.
    void difference(const SharedPicture& first, const SharedPicture& second, double scale,
                    const SharedPicture& into);

  private:
    const gl::Program& program(int what);
    void draw(const gl::Program& program, const SharedPicture& into);

    std::array<std::optional<gl::Program>, 9> programs_; // compiled when first used
    gl::Texture steps_, errorColours_, jodColours_, depthColours_;
    gl::TextureTarget target_;
    gl::ScreenTriangle triangle_;
};

} // namespace obscura
