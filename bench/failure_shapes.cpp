#include "bench/failure_scenes.h"
#include "bench/failure_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

namespace obscura {

namespace {

bool between(float value, double low, double high) {
    return low <= static_cast<double>(value) && static_cast<double>(value) < high;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

// Whichever of a test's views a technique does worst in.
struct Worst {
    double value = 0;
    std::string where = {};
    Image picture = {};
    const FailureView* view = nullptr;

    void offer(double found, const std::string& place, const Image& image,
               const FailureView& seen) {
        if (!view || std::abs(found) > std::abs(value))
            *this = {found, place, image, &seen};
    }
};

class PlaneTest : public FailureTest {
  public:
    explicit PlaneTest(ImageSize size) : scene_(floorScene()) {
        for (const double tilt : tilts)
            for (const double distance : {3, 10, 40}) {
                const FailureView& view = views_.emplace_back(scene_, floorCamera(tilt, distance), size);
                const double reach = 0.3 * size.width;
                places_.push_back({tilt, distance, view.select([&](const SeenPoint& point) {
                                       return between(point.degrees, tilt - 2.5, tilt + 2.5) &&
                                              between(point.pixelsAcross, -reach, reach);
                                   })});
            }
    }
    Finding measure(const TestedTechnique& technique) const override {
        Worst worst;
        std::vector<double> all;
        double largest = 0;
        std::map<double, std::vector<double>> byTilt;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Place& place = places_[i];
            const Image image = technique.visibility(views_[i].probe());
            const double found = meanOcclusion(image, place.selection);
            worst.offer(found, fmt::format("{}°, {} R away", place.tilt, place.distance), image,
                        views_[i]);
            all.push_back(found);
            byTilt[place.tilt].push_back(found);
            largest = std::max(largest, largestOcclusion(image, place.selection));
        }
        Finding finding{{{"occlusion at the worst tilt", worst.value, worst.where},
                         {"mean occlusion", mean(all)},
                         {"largest occlusion", largest}},
                        worst.picture,
                        worst.view->truth()};
        for (const auto& [tilt, values] : byTilt)
            finding.measures.push_back({fmt::format("mean at {}°", tilt), mean(values)});
        return finding;
    }
    const Image& truth() const override { return views_.front().truth(); }

  private:
    static constexpr double tilts[] = {0, 30, 60, 75, 80, 85};
    struct Place {
        double tilt, distance;
        Selection selection;
    };
    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Place> places_;
};

// How far a place differs from another of the same flat surface: both should be open.
class ContrastTest : public FailureTest {
  public:
    using Condition = bool (*)(const SeenPoint&);
    ContrastTest(const Scene& scene, const Camera& camera, ImageSize size, Condition place,
                 Condition plane, const char* measure)
        : scene_(scene), view_(scene_, camera, size), place_(view_.select(place)),
          plane_(view_.select(plane)), measure_(measure) {}
    Finding measure(const TestedTechnique& technique) const override {
        const Image image = technique.visibility(view_.probe());
        const double there = meanOcclusion(image, place_), plain = meanOcclusion(image, plane_);
        return {{{measure_, there - plain},
                 {"occlusion there", there},
                 {"occlusion of the plane", plain},
                 {"largest occlusion there", largestOcclusion(image, place_)}},
                image,
                view_.truth()};
    }
    const Image& truth() const override { return view_.truth(); }

  private:
    FailureScene scene_;
    FailureView view_;
    Selection place_, plane_;
    const char* measure_;
};

// Of selected floor beside an upright face at x = 0: the closed form.
double creaseOcclusion(const FailureView& view, const Selection& floor) {
    std::vector<double> values;
    for (std::size_t i = 0; i < floor.size(); ++i)
        if (floor[i])
            values.push_back(
                occlusionInCrease(std::abs(static_cast<double>(view.points()[i].position.x))));
    return mean(values);
}

// Distances of a point of the box from its three sides, the nearest first: 0, since it lies on one;
// then from the next edge.
std::array<float, 3> fromSides(const SeenPoint& point) {
    std::array<float, 3> result{-point.position.x, -point.position.y, -point.position.z};
    std::sort(result.begin(), result.end());
    return result;
}

bool besideEdge(const SeenPoint& point) {
    return between(fromSides(point)[1], 0, 0.25) && between(fromSides(point)[2], 1.3, 2.7);
}

bool farFromEdges(const SeenPoint& point) {
    return fromSides(point)[1] >= 1.3f && fromSides(point)[2] <= 2.7f;
}

// How far beside the pole's silhouette a point of the wall is.
float besidePole(const SeenPoint& point) {
    const float front = poleDistance + poleWidth / 2, camera = poleDistance + 6;
    const float silhouette = poleWidth / 2 * camera / (camera - front);
    return point.position.z < 1 ? std::abs(point.position.x) - silhouette : -1;
}

bool besideSilhouette(const SeenPoint& point) {
    return between(besidePole(point), 0, 2) && between(point.position.y, -5, 5);
}

bool farFromSilhouette(const SeenPoint& point) {
    return between(besidePole(point), 4.5, 8) && between(point.position.y, -5, 5);
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
        Finding finding{{}, image, view_.truth()};
        for (std::size_t i = 0; i < floors_.size(); ++i)
            finding.measures.push_back(
                {i ? fmt::format("error at w/h {:.2g}", rods[i].width / rodHeight)
                   : "error of occlusion at the thinnest",
                 difference(image, view_.truth(), floors_[i]).mean,
                 fmt::format("truth {:.3f}", meanOcclusion(view_.truth(), floors_[i]))});
        return finding;
    }
    const Image& truth() const override { return view_.truth(); }

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
        return {{{"error of occlusion a quarter radius from the face",
                  meanOcclusion(image, quarter_) - truth, fmt::format("truth {:.3f}", truth)},
                 {"mean error within a radius",
                  meanOcclusion(image, within_) - creaseOcclusion(view_, within_)}},
                image,
                view_.truth()};
    }
    const Image& truth() const override { return view_.truth(); }

  private:
    FailureScene scene_;
    FailureView view_;
    Selection quarter_, within_;
};

class GrazingTest : public FailureTest {
  public:
    explicit GrazingTest(ImageSize size) : scene_(creaseScene()) {
        for (const double degrees : angles) {
            const FailureView& view =
                views_.emplace_back(scene_, creaseCameraAlong(degrees), size);
            floors_.push_back(view.select([=](const SeenPoint& point) {
                return point.position.y < 0.01f && between(point.position.x, 0.1, 0.9) &&
                       between(point.degrees, degrees - 0.7, degrees + 0.7);
            }));
        }
    }
    Finding measure(const TestedTechnique& technique) const override {
        Worst worst;
        std::vector<double> errors;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const Image image = technique.visibility(views_[i].probe());
            errors.push_back(meanOcclusion(image, floors_[i]) -
                             creaseOcclusion(views_[i], floors_[i]));
            if (i > 0)
                worst.offer(errors[i] - errors[0], fmt::format("{}°", angles[i]), image, views_[i]);
        }
        Finding finding{{{"change of error from 45° to the worst angle", worst.value, worst.where}},
                        worst.picture,
                        worst.view->truth()};
        for (std::size_t i = 0; i < views_.size(); ++i)
            finding.measures.push_back({fmt::format("error at {}°", angles[i]), errors[i]});
        return finding;
    }
    const Image& truth() const override { return views_.back().truth(); }

  private:
    static constexpr double angles[] = {45, 80, 85, 87, 89};

    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Selection> floors_;
};

constexpr const char* glow = "occlusion beside the edge less that of the plane";
constexpr const char* halo = "occlusion beside the silhouette less that of the wall";

const FailureTestRow rows[] = {
    {{"plane", "Plane acne",
      "A floor with nothing on it, seen at 0 to 85 degrees from its normal from 3, 10 and 40 radii: "
      "the mean over the middle of the image, at the worst of them. Truth: 0.",
      "occlusion at the worst tilt", 0.02, 0.25},
     makeTest<PlaneTest>},
    {{"edge", "Edge highlight",
      "A convex box: a quarter radius beside its edges against the middle of its faces. Truth: no "
      "difference; negative glows.",
      glow, 0.02, 0.25},
     [](ImageSize size) -> std::unique_ptr<FailureTest> {
         return std::make_unique<ContrastTest>(boxScene(), boxCamera(), size, besideEdge,
                                               farFromEdges, glow);
     }},
    {{"halo", "Halo behind a pole",
      "A pole half a radius wide, 10 radii before a wall: the wall within 2 radii of its "
      "silhouette against the wall elsewhere. Truth: no difference.",
      halo, 0.02, 0.25},
     [](ImageSize size) -> std::unique_ptr<FailureTest> {
         return std::make_unique<ContrastTest>(poleScene(), poleCamera(), size, besideSilhouette,
                                               farFromSilhouette, halo);
     }},
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

std::span<const FailureTestRow> shapeTests() { return rows; }

} // namespace obscura
