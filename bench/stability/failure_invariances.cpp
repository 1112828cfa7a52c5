#include "bench/stability/failure_scenes.h"
#include "bench/stability/failure_test.h"
#include "bench/stability/rolled_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace obscura {

namespace {

// Each pixel as the mean of its block of 8 x 8: what is left when the grain of noise is taken away.
Image withoutGrain(const Image& image) {
    constexpr int block = 8;
    Image result = image;
    for (int top = 0; top < image.height; top += block)
        for (int left = 0; left < image.width; left += block) {
            const int bottom = std::min(top + block, image.height);
            const int right = std::min(left + block, image.width);
            float sum = 0;
            for (int y = top; y < bottom; ++y)
                for (int x = left; x < right; ++x)
                    sum += image.at(x, y, 0);
            for (int y = top; y < bottom; ++y)
                for (int x = left; x < right; ++x)
                    result.at(x, y, 0) = sum / static_cast<float>((bottom - top) * (right - left));
        }
    return result;
}

class BorderTest : public FailureTest {
  public:
    explicit BorderTest(ImageSize size)
        : scene_(hallScene()), view_(scene_, hallCamera(), size),
          guard_(64 * static_cast<int>(std::ceil(size.height / 160.0))) {
        const double ring = view_.radiusPixels();
        const auto inside = [=](const SeenPoint& point) {
            return std::abs(static_cast<double>(point.pixelsAcross)) < size.width / 2.0 - ring &&
                   std::abs(static_cast<double>(point.pixelsUp)) < size.height / 2.0 - ring;
        };
        middle_ = view_.select(inside);
        ring_ = view_.select([=](const SeenPoint& point) { return !inside(point); });
    }
    Finding measure(const TestedTechnique& technique) const override {
        const Image image = technique.visibility(view_.probe());
        const Image padded = technique.visibility(view_.probe(), guard_);
        const Image smooth = withoutGrain(image), smoothPadded = withoutGrain(padded);
        const Difference ring = difference(smooth, smoothPadded, ring_);
        const double middle = difference(smooth, smoothPadded, middle_).rms;
        return {std::sqrt(std::max(ring.rms * ring.rms - middle * middle, 0.0)),
                "",
                image,
                padded,
                {{"RMSE elsewhere, taken off", middle},
                 {"occlusion gained at the border", ring.mean},
                 {"largest difference", difference(image, padded, ring_).largest}}};
    }
    const FailureView& view() const override { return view_; }

  private:
    FailureScene scene_;
    FailureView view_;
    int guard_; // pixels: as far as techniques reach
    Selection ring_, middle_;
};

class ResolutionTest : public FailureTest {
  public:
    explicit ResolutionTest(ImageSize size)
        : scene_(hallScene()), coarse_(scene_, hallCamera(), {size.width / 2, size.height / 2}),
          fine_(scene_, hallCamera(), {size.width / 2 * ratio, size.height / 2 * ratio}) {
        const int width = size.width / 2;
        std::size_t i = 0;
        for (const SeenPoint& point : coarse_.points()) {
            const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
            ++i;
            glm::vec3 centre(0);
            forEachFine(x, y, width, [&](std::size_t at) {
                centre += fine_.points()[at].position / static_cast<float>(ratio * ratio);
            });
            smooth_.push_back(point.shown && glm::distance(centre, point.position) < 0.02f);
        }
    }
    Finding measure(const TestedTechnique& technique) const override {
        const Image image = technique.visibility(coarse_.probe());
        const Image large = technique.visibility(fine_.probe());
        Image shrunk{image.width, image.height, 1, {}};
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                float sum = 0;
                forEachFine(x, y, image.width, [&](std::size_t at) { sum += large.pixels[at]; });
                shrunk.pixels.push_back(sum / static_cast<float>(ratio * ratio));
            }
        const Difference found = difference(image, shrunk, smooth_);
        return {found.rms,
                fmt::format("{} lines against {}", image.height, large.height),
                onlySelected(image, smooth_),
                onlySelected(shrunk, smooth_),
                {{"occlusion gained by fewer lines", found.mean}}};
    }
    const FailureView& view() const override { return coarse_; }

  private:
    static constexpr int ratio = 4; // 540 lines against 2160

    template <typename Visit>
    static void forEachFine(int x, int y, int coarseWidth, Visit visit) {
        for (int row = y * ratio; row < (y + 1) * ratio; ++row)
            for (int column = x * ratio; column < (x + 1) * ratio; ++column)
                visit(static_cast<std::size_t>(row * coarseWidth * ratio + column));
    }

    FailureScene scene_;
    FailureView coarse_, fine_;
    Selection smooth_; // where a coarse pixel and its fine ones show one place
};

class RollTest : public FailureTest {
  public:
    explicit RollTest(ImageSize size) : scene_(hallScene()), level_(scene_, hallCamera(), size) {
        for (const double degrees : {15, 30, 45, 60, 75, 90})
            rolled_.emplace_back(scene_, level_, hallCamera(), degrees);
    }
    Finding measure(const TestedTechnique& technique) const override {
        const Image level = technique.visibility(level_.probe());
        std::vector<Finding::Measure> others;
        Worst worst;
        for (std::size_t i = 0; i < rolled_.size(); ++i) {
            const RolledView& rolled = rolled_[i];
            const Image image = rolled.turnedBack(technique.visibility(rolled.view().probe()));
            const Difference found = difference(image, level, rolled.same());
            const std::string place = fmt::format("{}°", rolled.degrees());
            others.push_back({"RMSE at " + place, found.rms});
            others.push_back({"occlusion gained at " + place, found.mean});
            worst.offer(found.rms, place, image, i);
        }
        const Selection& same = rolled_[worst.index].same();
        return {worst.value, worst.where, onlySelected(worst.picture, same),
                onlySelected(level, same), others};
    }
    const FailureView& view() const override { return level_; }

  private:
    FailureScene scene_;
    FailureView level_;
    std::deque<RolledView> rolled_;
};

class ScaleTest : public FailureTest {
  public:
    explicit ScaleTest(ImageSize size) {
        for (const double scale : scales) {
            scenes_.emplace_back(hallScene(scale));
            views_.emplace_back(scenes_.back(), hallCamera(scale), size);
        }
        all_ = views_.front().select([](const SeenPoint&) { return true; });
    }
    Finding measure(const TestedTechnique& technique) const override {
        const Image plain = technique.visibility(views_[0].probe());
        std::vector<Finding::Measure> others;
        Worst worst;
        for (std::size_t i = 1; i < views_.size(); ++i) {
            const Image image = technique.scaled(scales[i]).visibility(views_[i].probe());
            const double found = difference(image, plain, all_).rms;
            const std::string place = fmt::format("x {}", scales[i]);
            others.push_back({"RMSE at " + place, found});
            worst.offer(found, place, image, i);
        }
        return {worst.value, worst.where, worst.picture, plain, others};
    }
    const FailureView& view() const override { return views_.front(); }

  private:
    static constexpr double scales[] = {1, 0.01, 100};
    std::deque<FailureScene> scenes_;
    std::deque<FailureView> views_;
    Selection all_;
};

const FailureTestRow rows[] = {
    {{"border", "Screen border",
      "A hall, drawn alone and with a wide border that only the technique sees: how the image "
      "changes within a radius of its edge, in means of 8 x 8 pixels. Truth: not at all.",
      "RMSE within a radius of the border", 0.02, 0.15},
     makeTest<BorderTest>},
    {{"resolution", "Resolution change",
      "The hall with a quarter of the lines against all of them, averaged, where both show the "
      "same place (as 540 lines against 4K). Truth: no difference.",
      "RMSE of a quarter of the lines", 0.02, 0.15},
     makeTest<ResolutionTest>},
    {{"roll", "Camera roll",
      "The hall with the camera turned about its line of sight by 15 to 90 degrees, turned back, "
      "where both show the same place. Truth: no difference.",
      "RMSE at the worst roll", 0.02, 0.15},
     makeTest<RollTest>},
    {{"scale", "Scale",
      "The hall, its camera and the radius times 0.01 and times 100. Truth: the same image.",
      "RMSE at the worst scale", 0.01, 0.15},
     makeTest<ScaleTest>},
};

} // namespace

std::span<const FailureTestRow> invarianceTests() { return rows; }

} // namespace obscura
