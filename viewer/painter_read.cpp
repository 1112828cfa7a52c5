#include "gl/context.h"
#include "renderer/reference/traced.h"
#include "renderer/techniques/pass_shaders.h"
#include "viewer/painter.h"
#include "viewer/painter_state.h"

#include <algorithm>

namespace obscura {

Surfaces Painter::surfaces() const {
    const PainterState& s = *state_;
    return surfacesOf(s.subject->scene(), s.subject->pass(), s.buffers->sight().frame,
                      s.wanted.normals);
}

Image Painter::visibility(int pane) const {
    const PanePasses::Pane& shown = *state_->panes.at(static_cast<std::size_t>(pane));
    const int width = state_->wanted.width, height = state_->wanted.height;
    Image image{width, height, 1, {}};
    if (shown.settings.technique().passes.empty() && !shown.traced) {
        image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1);
        return image;
    }
    const std::vector<float> values =
        gl::readFloats(*shown.visibility, shown.width, shown.height, gl::Format::r32f);
    for (int y = shown.guard + height - 1; y >= shown.guard; --y) {
        const auto row = values.begin() + y * shown.width + shown.guard;
        image.pixels.insert(image.pixels.end(), row, row + width);
    }
    return image;
}

std::optional<Comparison> Painter::comparison() {
    PainterState& s = *state_;
    const Truth* truth = s.panes.empty() || !s.needsReference() ? nullptr : s.reference();
    if (!truth)
        return std::nullopt;
    const int width = s.wanted.width, height = s.wanted.height;
    bindFrame(s.buffers->sight().block);
    const auto compared = [&](const gl::Texture& visibility, bool sendsLight, int guard) {
        s.composited(visibility, sendsLight, guard);
        const std::vector<float> mean = s.composite->mean();
        return Comparison::Pane{flipped(mean, width, height, 4, 3, 1),
                                displayed(flipped(mean, width, height, 4, 0, 3))};
    };
    Comparison result;
    result.of = s.judged();
    result.rays = truth->rays;
    result.display = s.wanted.display;
    for (const PanePasses::Pane* pane : s.panes)
        result.panes.push_back(compared(*pane->visibility, pane->passes.sendsLight(), pane->guard));
    Comparison::Pane reference = compared(s.referenceTexture(), false, 0);
    result.visibility = std::move(reference.visibility);
    result.lit = std::move(reference.lit);
    const ViewBuffers::Sight& sight = s.buffers->sight();
    const Image depth =
        flipped(gl::readFloats(sight.gbuffer.depth(), width, height, gl::Format::r32f), width,
                height, 1, 0, 1);
    for (const float each : depth.pixels)
        result.shown.push_back(each < sight.frame.depth.y);
    gl::throwMessages();
    return result;
}

namespace {

glm::vec3 vec(const std::array<float, 4>& texel) { return {texel[0], texel[1], texel[2]}; }

// Of a smaller target it is the pixel that lies where the picture's does.
Probed::Pass passAt(const PanePasses::Pane& pane, const Pass& pass, int x, int y) {
    const gl::SlicedTarget& target = pane.passes.result(pass.name);
    const auto scaled = [](int at, int size, int full) { return at * size / full; };
    return {std::string(pass.name), gl::channelsOf(target.format()),
            gl::readTexel(target.texture(), scaled(x + pane.guard, target.width(), pane.width),
                          scaled(y + pane.guard, target.height(), pane.height))};
}

Probed::Pane paneAt(const PanePasses::Pane& pane, int x, int y) {
    Probed::Pane result;
    if (pane.settings.technique().passes.empty() && !pane.traced)
        return result;
    result.visibility =
        static_cast<double>(gl::readTexel(*pane.visibility, x + pane.guard, y + pane.guard)[0]);
    for (const Pass* pass : enabledPasses(pane.settings))
        if (pass->layers == 1) // the layers of others are no pictures
            result.passes.push_back(passAt(pane, *pass, x, y));
    return result;
}

} // namespace

std::optional<Probed> Painter::probe(int x, int y) const {
    PainterState& s = *state_;
    if (s.panes.empty() || x < 0 || y < 0 || x >= s.wanted.width || y >= s.wanted.height)
        return std::nullopt;
    Probed result;
    result.x = x;
    result.y = y;
    const int row = s.wanted.height - 1 - y;
    const Frame& frame = s.buffers->sight().frame;
    const GBuffer& gbuffer = s.buffers->sight().gbuffer;
    const float depth = gl::readTexel(gbuffer.depth(), x, row)[0];
    const glm::mat3 rotation(frame.worldFromView);
    result.surface = depth < frame.depth.y;
    result.depth = static_cast<double>(depth);
    const Surfaces surfaces{frame, s.wanted.width, s.wanted.height, {}, {}, {}};
    result.position = glm::vec3(
        frame.worldFromView *
        glm::vec4(surfaces.position(static_cast<float>(x), static_cast<float>(row), depth), 1));
    if (gbuffer.occlusionNormal())
        result.normal =
            glm::normalize(rotation * vec(gl::readTexel(*gbuffer.occlusionNormal(), x, row)));
    // OpenGL gives sRGB texels back as they are stored.
    const glm::vec3 albedo = vec(gl::readTexel(gbuffer.albedo(), x, row));
    result.albedo =
        glm::vec3(linearFromSrgb(albedo.r), linearFromSrgb(albedo.g), linearFromSrgb(albedo.b));
    for (std::size_t i = 0; i < s.panes.size(); ++i) {
        Probed::Pane pane = paneAt(*s.panes[i], x, row);
        if (s.wanted.show == Show::lit)
            pane.lit = vec(gl::readTexel(s.pictures[i].picture->texture, x, row)) * 255.0f;
        result.panes.push_back(std::move(pane));
    }
    if (const Truth* truth = s.needsReference() ? s.reference() : nullptr) {
        result.reference = static_cast<double>(truth->visibility->at(x, y, 0));
        result.referenceRays = truth->rays;
    }
    gl::throwMessages();
    return result;
}

} // namespace obscura
