#include "viewer/show_pass.h"

#include "image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>

namespace obscura {

struct PicturePool::Shelf {
    std::mutex mutex;
    std::vector<std::unique_ptr<SharedPicture>> pictures; // that nobody holds; the last came last
    bool closed = false;

    void putBack(std::unique_ptr<SharedPicture> picture) {
        const std::lock_guard lock(mutex);
        if (closed)
            picture->texture.release(); // there may be no context here
        else
            pictures.push_back(std::move(picture));
    }
};

PicturePool::PicturePool() : shelf_(std::make_shared<Shelf>()) {}

PicturePool::~PicturePool() {
    const std::lock_guard lock(shelf_->mutex);
    shelf_->closed = true;
    shelf_->pictures.clear();
}

std::shared_ptr<SharedPicture> PicturePool::take(int width, int height) {
    std::unique_ptr<SharedPicture> found;
    {
        const std::lock_guard lock(shelf_->mutex);
        auto& pictures = shelf_->pictures;
        std::erase_if(pictures, [&](const std::unique_ptr<SharedPicture>& each) {
            return each->width != width || each->height != height;
        });
        if (!pictures.empty()) {
            found = std::move(pictures.front());
            pictures.erase(pictures.begin());
        }
    }
    if (!found)
        found = std::make_unique<SharedPicture>(SharedPicture{
            gl::targetTexture(width, height, gl::Format::rgba8, "picture"), width, height});
    found->pixels.clear();
    return {found.release(), [shelf = shelf_](SharedPicture* picture) {
                shelf->putBack(std::unique_ptr<SharedPicture>(picture));
            }};
}

namespace {

// The order of shaders/show.frag.
enum What { lit, grey, albedo, normals, depth, error, jod, difference, luma };

constexpr int colourCount = 1024;
constexpr double worstJod = 7; // has the last colour

using Colours = std::vector<std::array<std::uint8_t, 3>>;

gl::Texture textureOf(const Colours& colours) {
    std::vector<std::uint8_t> codes;
    for (const auto& colour : colours) {
        codes.insert(codes.end(), colour.begin(), colour.end());
        codes.push_back(255);
    }
    return gl::imageTexture(static_cast<int>(colours.size()), 1, false, codes, {});
}

std::uint8_t codeOf(float linear) { return displayed(Image{1, 1, 1, {linear}}).pixels.front(); }

// The least float of 0 ... 1 that has each code: floats that are not negative are in the order of
// their bits.
std::vector<float> codeSteps() {
    std::vector<float> steps{0};
    for (int code = 1; code < 256; ++code) {
        auto low = std::bit_cast<std::uint32_t>(steps.back());
        auto high = std::bit_cast<std::uint32_t>(1.0f);
        while (low < high) {
            const std::uint32_t middle = low + (high - low) / 2;
            if (codeOf(std::bit_cast<float>(middle)) >= code)
                high = middle;
            else
                low = middle + 1;
        }
        steps.push_back(std::bit_cast<float>(low));
    }
    return steps;
}

gl::Program programOf(int what) {
    gl::ShaderText text;
    text.addFile(shaderFolder(), "frame.h");
    text.add(fmt::format("layout(std140, binding = 0) uniform FrameBlock {{ Frame frame; }};\n"
                         "#define WHAT {}\n",
                         what),
             "(generated declarations)");
    text.addFile(shaderFolder(), "show.frag");
    return gl::Program("show", shaderText("screen.vert"), text);
}

} // namespace

ShowPass::ShowPass()
    : steps_(gl::floatTexture(256, 1, codeSteps())),
      errorColours_(textureOf(errorColours(colourCount + 1))), // zero is one of them
      jodColours_(textureOf(jodColours(colourCount))),
      depthColours_(textureOf(depthColours(colourCount))) {}

const gl::Program& ShowPass::program(int what) {
    std::optional<gl::Program>& known = programs_[static_cast<std::size_t>(what)];
    if (!known)
        known.emplace(programOf(what));
    return *known;
}

void ShowPass::draw(const gl::Program& program, const SharedPicture& into) {
    gl::State{}.apply();
    target_.bind(into.texture, into.width, into.height);
    program.use();
    triangle_.draw();
}

void ShowPass::lit(const gl::Texture& displayLinear, const SharedPicture& into) {
    gl::bindTexture(0, displayLinear);
    gl::bindTexture(4, steps_);
    draw(program(What::lit), into);
}

void ShowPass::visibility(const Visibility& visibility, const SharedPicture& into) {
    const gl::Program& own = program(grey);
    own.set("guard", visibility.guard);
    gl::bindTexture(0, visibility.texture);
    gl::bindTexture(4, steps_);
    draw(own, into);
}

void ShowPass::albedo(const GBuffer& gbuffer, const SharedPicture& into) {
    gl::bindTexture(0, gbuffer.albedo());
    gl::bindTexture(2, gbuffer.depth());
    gl::bindTexture(4, steps_);
    draw(program(What::albedo), into);
}

void ShowPass::normals(const GBuffer& gbuffer, const SharedPicture& into) {
    gl::bindTexture(0, *gbuffer.occlusionNormal());
    gl::bindTexture(2, gbuffer.depth());
    draw(program(What::normals), into);
}

void ShowPass::depth(const GBuffer& gbuffer, double nearest, double farthest,
                     const SharedPicture& into) {
    const gl::Program& own = program(What::depth);
    const double soft = farthest / 50; // so that what is very near does not take all colours
    const std::array range{static_cast<float>(nearest), static_cast<float>(soft),
                           static_cast<float>(std::log((farthest + soft) / (nearest + soft))),
                           0.0f};
    own.set("range", std::span<const float, 4>(range));
    gl::bindTexture(0, gbuffer.depth());
    gl::bindTexture(2, gbuffer.depth());
    gl::bindTexture(3, depthColours_);
    draw(own, into);
}

void ShowPass::error(const Visibility& visibility, const gl::Texture& reference,
                     const GBuffer& gbuffer, double scale, const SharedPicture& into) {
    const gl::Program& own = program(What::error);
    own.set("guard", visibility.guard);
    own.set("scale", static_cast<float>(scale));
    gl::bindTexture(0, visibility.texture);
    gl::bindTexture(1, reference);
    gl::bindTexture(2, gbuffer.depth());
    gl::bindTexture(3, errorColours_);
    draw(own, into);
}

void ShowPass::jod(const gl::Texture& map, const SharedPicture& into) {
    const gl::Program& own = program(What::jod);
    own.set("scale", static_cast<float>(1 - worstJod / 10));
    gl::bindTexture(0, map);
    gl::bindTexture(3, jodColours_);
    draw(own, into);
}

void ShowPass::difference(const Visibility& first, const Visibility& second, const GBuffer& gbuffer,
                          double scale, const SharedPicture& into) {
    const gl::Program& own = program(What::difference);
    own.set("guard", first.guard);
    own.set("otherGuard", second.guard);
    own.set("scale", static_cast<float>(scale));
    gl::bindTexture(0, first.texture);
    gl::bindTexture(1, second.texture);
    gl::bindTexture(2, gbuffer.depth());
    gl::bindTexture(3, errorColours_);
    draw(own, into);
}

void ShowPass::difference(const SharedPicture& first, const SharedPicture& second, double scale,
                          const SharedPicture& into) {
    const gl::Program& own = program(luma);
    own.set("scale", static_cast<float>(scale));
    gl::bindTexture(0, first.texture);
    gl::bindTexture(1, second.texture);
    gl::bindTexture(3, errorColours_);
    draw(own, into);
}

} // namespace obscura
