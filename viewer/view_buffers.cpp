#include "viewer/view_buffers.h"

#include "protocols/reader/manifest.h"

#include <algorithm>

namespace obscura {

namespace {

constexpr std::uint64_t seed = 1; // of techniques' noise

// Of all that lighting reads: what the composite reads may change without new shadows.
std::string lightingText(const Level& level) {
    const Level untouched;
    Recipe recipe;
    recipe.level = level;
    recipe.level.name.clear();
    recipe.level.curve = untouched.curve;
    recipe.level.white = untouched.white;
    recipe.level.occludeDirect = untouched.occludeDirect;
    return recipe.json();
}

std::string viewText(const Wanted& wanted) {
    Recipe recipe;
    recipe.view.camera = wanted.view.camera;
    recipe.width = wanted.width;
    recipe.height = wanted.height;
    recipe.normals = wanted.normals;
    return recipe.json();
}

bool holds(const GBufferContent& content, const GBufferContent& needed) {
    return (content.albedo || !needed.albedo) && (content.emission || !needed.emission) &&
           (content.shadingNormal || !needed.shadingNormal) &&
           (!needed.occlusionNormal || content.occlusionNormal == needed.occlusionNormal);
}

std::optional<Normals> occlusionNormals(const Wanted& wanted) {
    std::optional<Normals> result;
    if (wanted.show == Show::normals)
        result = wanted.normals;
    for (const Settings& settings : wanted.panes)
        if (guardPixels(settings, wanted.height) == 0 && !result)
            result = normalsFor(settings.technique(), wanted.normals);
    return result;
}

} // namespace

bool ViewBuffers::isLit(const Level& level) const {
    return lighting_ && level_ == lightingText(level);
}

void ViewBuffers::light(const Level& level) {
    if (isLit(level))
        return;
    lighting_.emplace(Lighting(level, subject_.scene(), level.environment));
    level_ = lightingText(level);
    ++lighted_;
}

bool ViewBuffers::see(const Wanted& wanted) {
    std::string text = viewText(wanted);
    if (text == seen_)
        return false;
    seen_ = std::move(text);
    camera_ = wanted.view.camera;
    width_ = wanted.width;
    height_ = wanted.height;
    ++view_;
    return true;
}

bool ViewBuffers::draw(int guard, const GBufferContent& content, bool white, bool sharp) {
    sharp = sharp || !subject_.scene().sharpens();
    const auto known = sights_.find(guard);
    if (known != sights_.end() && known->second.view == view_ && known->second.white == white &&
        (known->second.sharp || !sharp) && holds(known->second.gbuffer.content(), content))
        return false;
    const int width = width_ + 2 * guard, height = height_ + 2 * guard;
    const Frame frame =
        makeFrame(camera_, width_, height_, subject_.scene().bounds(), seed, {0, 0}, guard);
    const bool fits = known != sights_.end() && known->second.gbuffer.target().width() == width &&
                      known->second.gbuffer.target().height() == height &&
                      holds(known->second.gbuffer.content(), content) &&
                      holds(content, known->second.gbuffer.content());
    GBuffer gbuffer = fits ? std::move(known->second.gbuffer) : GBuffer(width, height, content);
    sights_.erase(guard);
    const Sight& sight = sights_
                             .emplace(guard, Sight{frame, frameBuffer(frame), std::move(gbuffer),
                                                   white, sharp, view_, ++drawn_})
                             .first->second;
    bindFrame(sight.block);
    subject_.scene().sharpen(sharp);
    subject_.pass().draw(subject_.scene(), frame, sight.gbuffer);
    subject_.scene().sharpen(true);
    if (white && content.albedo) // and no metal
        sight.gbuffer.target().clear(0, {1, 1, 1, 0});
    return true;
}

bool ViewBuffers::drawGBuffer(const Wanted& wanted, bool lit, bool sharp) {
    // Wider ones of views past are of no use, but for their memory.
    std::erase_if(sights_, [&](const auto& each) {
        return each.first > 0 &&
               std::none_of(wanted.panes.begin(), wanted.panes.end(), [&](const Settings& pane) {
                   return guardPixels(pane, wanted.height) == each.first;
               });
    });
    GBufferContent content;
    content.shadingNormal = lit && lighting_->readsNormals();
    content.occlusionNormal = occlusionNormals(wanted);
    content.emission = lit && wanted.textures && subject_.scene().emits();
    return draw(0, content, !wanted.textures, sharp);
}

bool ViewBuffers::drawPadded(const Wanted& wanted, const Settings& settings) {
    const int guard = guardPixels(settings, wanted.height);
    return guard > 0 &&
           draw(guard, {false, false, normalsFor(settings.technique(), wanted.normals)}, false,
                true);
}

bool ViewBuffers::drawLight() {
    const Sight& seen = sight();
    const std::array<std::uint64_t, 2> from{seen.version, lighted_};
    if (light_ && litFrom_ == from)
        return false;
    const gl::Target& target = seen.gbuffer.target();
    if (!light_ || light_->target().width() != target.width() ||
        light_->target().height() != target.height() ||
        (light_->target().count() > 1) != lighting_->hasDirect())
        light_.emplace(target.width(), target.height(), lighting_->hasDirect());
    bindFrame(seen.block);
    lighting_->draw(seen.gbuffer, *light_);
    litFrom_ = from;
    ++lightVersion_;
    return true;
}

void ViewBuffers::forget() {
    ++view_;
    litFrom_ = {};
}

std::array<double, 2> ViewBuffers::depthRange() const {
    const Frame& frame = sight().frame;
    const Bounds& bounds = subject_.scene().bounds();
    double low = frame.depth.y, high = frame.depth.x;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 position(corner & 1 ? bounds.high.x : bounds.low.x,
                                 corner & 2 ? bounds.high.y : bounds.low.y,
                                 corner & 4 ? bounds.high.z : bounds.low.z, 1);
        const double depth = -(frame.viewFromWorld * position).z;
        low = std::min(low, depth);
        high = std::max(high, depth);
    }
    low = std::max(low, static_cast<double>(frame.depth.x));
    return {low, std::max(high, low * 1.001)};
}

} // namespace obscura
