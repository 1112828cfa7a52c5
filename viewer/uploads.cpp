#include "viewer/uploads.h"

#include "gl/screen.h"

#include <algorithm>

namespace obscura {

const gl::Texture& Uploads::of(const std::shared_ptr<const SharedPicture>& picture) {
    if (picture->pixels.empty())
        return picture->texture;
    const auto known = std::find_if(uploads_.begin(), uploads_.end(),
                                    [&](const Upload& each) { return each.picture == picture; });
    if (known != uploads_.end()) {
        known->used = true;
        return known->texture;
    }
    uploads_.push_back({picture, gl::uploaded(picture->width, picture->height, picture->pixels)});
    return uploads_.back().texture;
}

void Uploads::forget() {
    std::erase_if(uploads_, [](Upload& each) { return !std::exchange(each.used, false); });
}

} // namespace obscura
