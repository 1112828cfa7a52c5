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

class PlaneTest : public FailureTest {
  public:
    explicit PlaneTest(ImageSize size) : scene_(floorScene()) {
        for (const double tilt : tilts)
            for (const double distance : {3, 10, 40}) {
                const FailureView& view =
                    views_.emplace_back(scene_, floorCamera(tilt, distance), size);
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
            worst.offer(found, fmt::format("{}°, {} R away", place.tilt, place.distance), image, i);
            all.push_back(found);
            byTilt[place.tilt].push_back(found);
            largest = std::max(largest, largestOcclusion(image, place.selection));
        }
        Finding finding{{{"occlusion at the worst tilt", worst.value, worst.where},
                         {"mean occlusion", mean(all)},
                         {"largest occlusion", largest}},
                        worst.picture,
                        views_[worst.index].truth()};
        for (const auto& [tilt, values] : byTilt)
            finding.measures.push_back({fmt::format("mean at {}°", tilt), mean(values)});
        return finding;
    }
    const FailureView& view() const override { return views_.front(); }

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

using Condition = std::function<bool(const SeenPoint&)>;

// A place of a flat surface, and another that should be as open.
struct Contrast {
    std::string name;
    Scene scene;
    Camera camera;
    Condition place, plane;
};

class ContrastTest : public FailureTest {
  public:
    ContrastTest(const std::vector<Contrast>& contrasts, ImageSize size, const char* measure)
        : measure_(measure) {
        for (const Contrast& contrast : contrasts) {
            scenes_.emplace_back(contrast.scene);
            const FailureView& view = views_.emplace_back(scenes_.back(), contrast.camera, size);
            places_.push_back(
                {contrast.name, view.select(contrast.place), view.select(contrast.plane)});
        }
    }
    Finding measure(const TestedTechnique& technique) const override {
        std::vector<Measured> measures;
        Worst worst;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Place& at = places_[i];
            const Image image = technique.visibility(views_[i].probe());
            const double there = meanOcclusion(image, at.place);
            const double plain = meanOcclusion(image, at.plane);
            worst.offer(there - plain, at.name, image, i);
            measures.push_back({"occlusion there" + at.name, there});
            measures.push_back({"occlusion of the plane" + at.name, plain});
            measures.push_back(
                {"largest occlusion there" + at.name, largestOcclusion(image, at.place)});
        }
        measures.insert(measures.begin(), {measure_, worst.value, worst.where});
        return {measures, worst.picture, views_[worst.index].truth()};
    }
    const FailureView& view() const override { return views_.front(); }

  private:
    struct Place {
        std::string name;
        Selection place, plane;
    };
    const char* measure_;
    std::deque<FailureScene> scenes_;
    std::deque<FailureView> views_;
    std::vector<Place> places_;
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

// A part of the wall between these distances from the pole's silhouette, of all heights but those
// near the image's borders.
Condition besidePole(double distance, double low, double high) {
    const double camera = distance + static_cast<double>(poleToCamera);
    const double half = static_cast<double>(poleWidth) / 2;
    const double silhouette = half * camera / (camera - distance - half);
    return [=](const SeenPoint& point) {
        return point.position.z < 0.5f && std::abs(point.position.y) < 2.5f &&
               between(std::abs(point.position.x), silhouette + low, silhouette + high);
    };
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
        return {{{"error of occlusion a quarter radius from the face",
                  meanOcclusion(image, quarter_) - truth, fmt::format("truth {:.3f}", truth)},
                 {"mean error within a radius",
                  meanOcclusion(image, within_) - creaseOcclusion(view_, within_)}},
                image,
                view_.truth()};
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
        Worst worst;
        std::vector<double> errors;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const Image image = technique.visibility(views_[i].probe());
            errors.push_back(meanOcclusion(image, floors_[i]) -
                             creaseOcclusion(views_[i], floors_[i]));
            if (i > 0)
                worst.offer(errors[i] - errors[0], fmt::format("{}°", angles[i]), image, i);
        }
        Finding finding{{{"change of error from 45° to the worst angle", worst.value, worst.where}},
                        worst.picture,
                        views_[worst.index].truth()};
        for (std::size_t i = 0; i < views_.size(); ++i)
            finding.measures.push_back({fmt::format("error at {}°", angles[i]), errors[i]});
        return finding;
    }
    const FailureView& view() const override { return views_.back(); }

  private:
    static constexpr double angles[] = {45, 80, 85, 87, 89};

    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Selection> floors_;
};

constexpr const char* glow = "occlusion beside the edge less that of the plane";
constexpr const char* halo = "occlusion beside the silhouette less that of the wall";

std::unique_ptr<FailureTest> makeEdgeTest(ImageSize size) {
    const std::vector<Contrast> contrasts{{"", boxScene(), boxCamera(), besideEdge, farFromEdges}};
    return std::make_unique<ContrastTest>(contrasts, size, glow);
}

std::unique_ptr<FailureTest> makeHaloTest(ImageSize size) {
    std::vector<Contrast> contrasts;
    for (const double distance : {10.0, 3.0, 1.5})
        contrasts.push_back({fmt::format(", pole {} R before the wall", distance),
                             poleScene(distance), poleCamera(distance), besidePole(distance, 0, 2),
                             besidePole(distance, 4.5, 7)});
    return std::make_unique<ContrastTest>(contrasts, size, halo);
}

const FailureTestRow rows[] = {
    {{"plane", "Plane acne",
      "A floor with nothing on it, seen at 0 to 85 degrees from its normal from 3, 10 and 40 "
      "radii: "
      "the mean over the middle of the image, at the worst of them. Truth: 0.",
      "occlusion at the worst tilt", 0.02, 0.25},
     makeTest<PlaneTest>},
    {{"edge", "Edge highlight",
      "A convex box: a quarter radius beside its edges against the middle of its faces. Truth: no "
      "difference; negative glows.",
      glow, 0.02, 0.25},
     makeEdgeTest},
    {{"halo", "Halo behind a pole",
      "A pole half a radius wide stands 10, 3 and 1.5 radii before a wall: the wall within 2 "
      "radii of its silhouette against the wall elsewhere, where that is worst. Truth: no "
      "difference.",
      halo, 0.02, 0.25},
     makeHaloTest},
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
