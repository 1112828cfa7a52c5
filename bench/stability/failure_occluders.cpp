#include "bench/stability/failure_scenes.h"
#include "bench/stability/failure_test.h"

#include <fmt/format.h>

#include <cmath>
#include <deque>

namespace obscura {

namespace {

// Of selected floor beside an upright face at x = 0: the closed form.
double creaseOcclusion(const FailureView& view, const Selection& floor) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < floor.size(); ++i)
        if (floor[i]) {
            sum += occlusionInCrease(std::abs(static_cast<double>(view.points()[i].position.x)));
            ++count;
        }
    return sum / count;
}

class RodTest : public FailureTest {
  public:
    explicit RodTest(ImageSize size) : scene_(rodScene()), view_(scene_, rodCamera(), size) {
        for (const Rod& rod : rods)
            floors_.push_back(view_.select([&](const SeenPoint& point) {
                return std::abs(point.position.y) < 0.01f &&
                       between(point.position.z, rod.z - 1, rod.z + 1) &&
                       between(point.position.x, -3, 3);
            }));
    }
    Finding measure(const TestedTechnique& technique) const override {
        const Image image = technique.visibility(view_.probe());
        std::vector<Finding::Measure> errors;
        for (std::size_t i = 0; i < floors_.size(); ++i)
            errors.push_back(
                {fmt::format("error at w/h {:.2g}", rods[i].width / rodHeight),
                 difference(image, view_.truth(), floors_[i]).mean,
                 fmt::format("truth {:.3f}", meanOcclusion(view_.truth(), floors_[i]))});
        return {errors[0].value, errors[0].note, image, view_.truth(), errors};
    }
    const FailureView& view() const override { return view_; }

  private:
    FailureScene scene_;
    FailureView view_;
    std::vector<Selection> floors_;
};

class HiddenTest : public FailureTest {
  public:
    explicit HiddenTest(ImageSize size) : scene_(curbScene()), view_(scene_, curbCamera(), size) {
        const auto floor = [&](double low, double high) {
            return view_.select([=](const SeenPoint& point) {
                return std::abs(point.position.y) < 0.01f && between(-point.position.x, low, high);
            });
        };
        quarter_ = floor(0.22, 0.28);
        within_ = floor(0, 1);
    }
    Finding measure(const TestedTechnique& technique) const override {
        const Image image = technique.visibility(view_.probe());
        const double truth = creaseOcclusion(view_, quarter_);
        return {meanOcclusion(image, quarter_) - truth,
                fmt::format("truth {:.3f}", truth),
                image,
                view_.truth(),
                {{"mean error within a radius",
                  meanOcclusion(image, within_) - creaseOcclusion(view_, within_)}}};
    }
    const FailureView& view() const override { return view_; }

  private:
    FailureScene scene_;
    FailureView view_;
    Selection quarter_, within_;
};

class GrazingTest : public FailureTest {
  public:
    explicit GrazingTest(ImageSize size) : scene_(creaseScene()) {
        for (const double degrees : angles) {
            const FailureView& view = views_.emplace_back(scene_, creaseCameraAlong(degrees), size);
            floors_.push_back(view.select([=](const SeenPoint& point) {
                return point.position.y < 0.01f && between(point.position.x, 0.1, 0.9) &&
                       between(point.degrees, degrees - 0.7, degrees + 0.7);
            }));
        }
    }
    Finding measure(const TestedTechnique& technique) const override {
        std::vector<Finding::Measure> errors;
        Worst worst;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const Image image = technique.visibility(views_[i].probe());
            const std::string place = fmt::format("{}°", angles[i]);
            errors.push_back({"error at " + place, meanOcclusion(image, floors_[i]) -
                                                       creaseOcclusion(views_[i], floors_[i])});
            worst.offer(errors[i].value - errors[0].value, place, image, i);
        }
        return {worst.value, worst.where, worst.picture, views_[worst.index].truth(), errors};
    }
    const FailureView& view() const override { return views_.back(); }

  private:
    static constexpr double angles[] = {45, 80, 85, 87, 89};

    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Selection> floors_;
};

const FailureTestRow rows[] = {
    {{"thin", "Thin occluder",
      "Rods 0.1, 0.25 and 0.6 radii thick float 0.3 above a floor: the floor within a radius of "
      "them against ray tracing. Positive is too dark.",
      "error of occlusion at the thinnest", 0.03, 0.25},
     makeTest<RodTest>},
    {{"hidden", "Hidden face",
      "A step of 2 radii from above, whose upright face no pixel shows: the floor before it "
      "against the closed form, 0.342.",
      "error of occlusion a quarter radius from the face", 0.05, 0.34},
     makeTest<HiddenTest>},
    {{"grazing", "Grazing angle",
      "A floor beside a wall, seen along the wall at 80 to 89 degrees from the floor's normal: how "
      "the error against the closed form changes from what it is at 45.",
      "change of error from 45° to the worst angle", 0.03, 0.25},
     makeTest<GrazingTest>},
};

} // namespace

std::span<const FailureTestRow> occluderTests() { return rows; }

} // namespace obscura
