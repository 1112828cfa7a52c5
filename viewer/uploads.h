#pragma once

#include "viewer/picture.h"

#include <memory>
#include <vector>

namespace obscura {

// Textures of the window's own context for pictures that came as bytes: those of a worker whose
// context shares nothing with it.
class Uploads {
  public:
    // The picture's texture, or one that was made of its bytes. The window's context is current.
    const gl::Texture& of(const std::shared_ptr<const SharedPicture>& picture);
    // Forgets what has not been asked for since the last call.
    void forget();

  private:
    struct Upload {
        std::shared_ptr<const SharedPicture> picture;
        gl::Texture texture;
        bool used = true;
    };
    std::vector<Upload> uploads_;
};

} // namespace obscura
