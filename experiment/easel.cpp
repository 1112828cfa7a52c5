#include "experiment/easel.h"

#include <algorithm>

namespace obscura {

void Easel::show(const std::vector<Drawing>& drawings, int grey, const std::string& title) {
    hung_.clear();
    for (const auto& [image, x, y] : drawings)
        hung_.push_back({{image.width, image.height, image.channels, image.pixels}, x, y});
    grey_ = grey;
    redraw();
    window_.setTitle("Obscura: " + title);
}

void Easel::redraw() {
    window_.clear(grey_);
    for (const Hung& one : hung_)
        window_.draw(one.picture, one.x, one.y);
    window_.swap();
}

std::vector<gl::Input> Easel::inputs() {
    using Kind = gl::Input::Kind;
    for (;;) {
        std::vector<gl::Input> inputs = window_.wait();
        if (std::any_of(inputs.begin(), inputs.end(),
                        [](const gl::Input& input) { return input.kind == Kind::exposed; }))
            redraw();
        for (gl::Input& input : inputs)
            if (input.kind == Kind::close) {
                input.kind = Kind::press;
                input.key = gl::Key::escape;
            }
        std::erase_if(inputs, [](const gl::Input& input) {
            return input.kind != Kind::press && input.kind != Kind::text &&
                   input.kind != Kind::click && input.kind != Kind::drag;
        });
        if (!inputs.empty())
            return inputs;
    }
}

} // namespace obscura
