#include "bench/stability/failure_scenes.h"
#include "bench/stability/failure_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

namespace obscura {

namespace {

class PlaneTest : public FailureTest {
  public:
    explicit PlaneTest(ImageSize size) : scene_(floorScene()) {
        const double reach = 0.3 * size.width;
        for (const double tilt : {0, 30, 60, 75, 80, 85})
            for (const double distance : {3, 10, 40}) {
                const FailureView& view =
                    views_.emplace_back(scene_, floorCamera(tilt, distance), size);
                const Selection middle = view.select([=](const SeenPoint& point) {
                    return between(point.degrees, tilt - 2.5, tilt + 2.5) &&
                           between(point.pixelsAcross, -reach, reach);
                });
                places_.push_back({fmt::format("{}°, {} R away", tilt, distance), middle});
            }
    }
    Finding measure(const TestedTechnique& technique) const override {
        std::vector<Finding::Measure> others;
        Worst worst;
        double sum = 0, largest = 0;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Place& at = places_[i];
            const Image image = technique.visibility(views_[i].probe());
            const double found = meanOcclusion(image, at.middle);
            worst.offer(found, at.name, image, i);
            others.push_back({"occlusion at " + at.name, found});
            sum += found;
            largest = std::max(largest, largestOcclusion(image, at.middle));
        }
        others.push_back({"mean of these", sum / static_cast<double>(places_.size())});
        others.push_back({"largest occlusion of a pixel", largest});
        return {worst.value, worst.where, worst.picture, views_[worst.index].truth(), others};
    }
    const FailureView& view() const override { return views_.front(); }

  private:
    struct Place {
        std::string name;
        Selection middle;
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
    ContrastTest(const std::vector<Contrast>& contrasts, ImageSize size) {
        for (const Contrast& contrast : contrasts) {
            scenes_.emplace_back(contrast.scene);
            const FailureView& view = views_.emplace_back(scenes_.back(), contrast.camera, size);
            places_.push_back(
                {contrast.name, view.select(contrast.place), view.select(contrast.plane)});
        }
    }
    Finding measure(const TestedTechnique& technique) const override {
        std::vector<Finding::Measure> others;
        Worst worst;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Place& at = places_[i];
            const Image image = technique.visibility(views_[i].probe());
            const double there = meanOcclusion(image, at.place);
            const double plain = meanOcclusion(image, at.plane);
            worst.offer(there - plain, at.name, image, i);
            others.push_back({"occlusion there, " + at.name, there});
            others.push_back({"occlusion of the plane, " + at.name, plain});
            others.push_back(
                {"largest occlusion there, " + at.name, largestOcclusion(image, at.place)});
        }
        return {worst.value, worst.where, worst.picture, views_[worst.index].truth(), others};
    }
    const FailureView& view() const override { return views_.front(); }

  private:
    struct Place {
        std::string name;
        Selection place, plane;
    };
    std::deque<FailureScene> scenes_;
    std::deque<FailureView> views_;
    std::vector<Place> places_;
};

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

std::unique_ptr<FailureTest> makeEdgeTest(ImageSize size) {
    const std::vector<Contrast> contrasts{
        {"box", boxScene(), boxCamera(), besideEdge, farFromEdges}};
    return std::make_unique<ContrastTest>(contrasts, size);
}

std::unique_ptr<FailureTest> makeHaloTest(ImageSize size) {
    std::vector<Contrast> contrasts;
    for (const double distance : {10.0, 3.0, 1.5})
        contrasts.push_back({fmt::format("pole {} R before the wall", distance),
                             poleScene(distance), poleCamera(distance), besidePole(distance, 0, 2),
                             besidePole(distance, 4.5, 7)});
    return std::make_unique<ContrastTest>(contrasts, size);
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
      "occlusion beside the edge less that of the plane", 0.02, 0.25},
     makeEdgeTest},
    {{"halo", "Halo behind a pole",
      "A pole half a radius wide stands 10, 3 and 1.5 radii before a wall: the wall within 2 "
      "radii of its silhouette against the wall elsewhere, where that is worst. Truth: no "
      "difference.",
      "occlusion beside the silhouette less that of the wall", 0.02, 0.25},
     makeHaloTest},
};

} // namespace

std::span<const FailureTestRow> openTests() { return rows; }

} // namespace obscura
