#include "bench/stability/failure_scenes.h"
#include "bench/stability/failure_test.h"
#include "bench/stability/stored_depth.h"
#include "bench/stability/tile_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

namespace obscura {

namespace {

// On the floor or the wall of the crease: how far from the edge.
float fromCrease(const SeenPoint& point) { return std::max(point.position.x, point.position.y); }

Selection creaseBand(const FailureView& view, float low, float high) {
    return view.select([=](const SeenPoint& point) {
        return low <= fromCrease(point) && fromCrease(point) < high;
    });
}

class CloseTest : public FailureTest {
  public:
    explicit CloseTest(ImageSize size) : scene_(creaseScene()) {
        for (const double distance : distances) {
            views_.emplace_back(scene_, creaseCamera(distance, 1.155 * distance), size);
            bands_.push_back(creaseBand(views_.back(), 0.02f, 0.08f));
        }
    }
    Finding measure(const TestedTechnique& technique) const override {
        std::vector<Finding::Measure> found;
        Image image;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            image = technique.visibility(views_[i].probe());
            found.push_back({fmt::format("occlusion from {} R away", distances[i]),
                             meanOcclusion(image, bands_[i])});
        }
        const double change = found.back().value - found.front().value;
        found.push_back({"time near / far",
                         technique.seconds(views_.back().probe(), runs) /
                             technique.seconds(views_.front().probe(), runs),
                         "wall time on this machine, read-back included"});
        return {change, "", image, views_.back().truth(), found};
    }
    const FailureView& view() const override { return views_.back(); }

  private:
    static constexpr double distances[] = {2, 0.8, 0.4, 0.2, 0.1};
    static constexpr int runs = 5;
    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Selection> bands_;
};

class FarDepthTest : public FailureTest {
  public:
    explicit FarDepthTest(ImageSize size) : scene_(creaseScene()) {
        const std::pair<const char*, Probe::StoredDepth> formats[] = {
            {"32-bit", {}}, {"24-bit", fixedPointDepths()}, {"16-bit float", halfFloatDepths()}};
        for (const auto& [name, stored] : formats)
            for (const double distance : {5, 10, 100, 1000}) {
                views_.emplace_back(scene_, creaseCamera(distance, 5.2), size, stored);
                places_.push_back({fmt::format("{} at {} R", name, distance),
                                   creaseBand(views_.back(), 1.5f, 2.2f),
                                   creaseBand(views_.back(), 0.15f, 0.5f), distance <= 100});
            }
    }
    Finding measure(const TestedTechnique& technique) const override {
        std::vector<Finding::Measure> others;
        Worst worst;
        double nearPlane = 0, nearCrease = 0;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Place& at = places_[i];
            const Image image = technique.visibility(views_[i].probe());
            const double plane = meanOcclusion(image, at.plane);
            const double crease = meanOcclusion(image, at.crease);
            others.push_back({"plane, " + at.name, plane});
            others.push_back({"crease, " + at.name, crease});
            nearPlane = i == 0 ? plane : nearPlane;
            nearCrease = i == 0 ? crease : nearCrease;
            if (!at.counts)
                continue;
            worst.offer(plane - nearPlane, "plane, " + at.name, image, i);
            worst.offer(crease - nearCrease, "crease, " + at.name, image, i);
        }
        return {worst.value, worst.where, worst.picture, views_[worst.index].truth(), others};
    }
    const FailureView& view() const override { return views_.front(); }

  private:
    struct Place {
        std::string name;
        Selection plane, crease;
        bool counts; // false so far away that fewer bits leave nothing of any scene
    };
    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Place> places_;
};

class BandingTest : public FailureTest {
  public:
    explicit BandingTest(ImageSize size) : crease_(creaseScene()), rods_(rodScene()) {
        const double window = 0.45 * size.height;
        const auto middle = [=](const SeenPoint& point) {
            return std::hypot(static_cast<double>(point.pixelsAcross),
                              static_cast<double>(point.pixelsUp)) < window;
        };
        const auto besideCrease = [=](const SeenPoint& point) {
            return middle(point) && between(fromCrease(point), 0.2, 0.8);
        };
        add("close by", crease_, creaseCamera(6, 2.7), size, besideCrease);
        add("farther", crease_, creaseCamera(6, 10), size, besideCrease);
        add("floor at 80°", crease_, creaseCamera(6, 2.7, 10), size, besideCrease);
        add("among rods", rods_, rodCamera(), size, middle);
    }
    Finding measure(const TestedTechnique& technique) const override {
        std::vector<Finding::Measure> others;
        Worst worst;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Place& at = places_[i];
            const Image image = technique.visibility(views_[i].probe());
            const Image levelled = withDiagonalsLevelled(image, at.patch);
            for (const int period : {3, 4}) {
                const TilePattern found = tilePattern(image, levelled, at.patch, period);
                const std::string name = fmt::format("{} x {}, {}", period, period, at.name);
                worst.offer(found.amplitude, name, image, i);
                others.push_back({"RMS, " + name, found.amplitude});
                others.push_back({"share of the grain's energy, " + name, found.share});
            }
            others.push_back(
                {"RMS of all grain, " + at.name, difference(image, levelled, at.patch).rms});
        }
        for (const char* filter : {"blur", "denoise"})
            if (technique.settings().has(filter))
                others.push_back(
                    {"RMS, 4 x 4, farther, unfiltered", unfiltered(technique, filter)});
        return {worst.value, worst.where, worst.picture,
                withDiagonalsLevelled(worst.picture, places_[worst.index].patch), others};
    }
    const FailureView& view() const override { return views_.back(); }

  private:
    struct Place {
        std::string name;
        Selection patch;
    };
    static constexpr std::size_t farther = 1;
    double unfiltered(const TestedTechnique& technique, const char* filter) const {
        const TestedTechnique raw(fmt::format("{} {}=0", technique.configuration(), filter));
        const Image image = raw.visibility(views_[farther].probe());
        const Selection& patch = places_[farther].patch;
        return tilePattern(image, withDiagonalsLevelled(image, patch), patch, 4).amplitude;
    }
    void add(const char* name, const FailureScene& scene, const Camera& camera, ImageSize size,
             const std::function<bool(const SeenPoint&)>& patch) {
        views_.emplace_back(scene, rolled(camera, -45), size);
        places_.push_back({name, views_.back().select(patch)});
    }

    FailureScene crease_, rods_;
    std::deque<FailureView> views_;
    std::vector<Place> places_;
};

const FailureTestRow rows[] = {
    {{"close", "Camera too close",
      "A crease from 2 radii away and from 0.1, where a radius is many screens wide: what becomes "
      "of the occlusion in it. Truth: nothing; negative is lost.",
      "change of occlusion in the crease on coming near", 0.05, 0.4},
     makeTest<CloseTest>},
    {{"far", "Far depth",
      "A right angle through longer and longer lenses, 5 to 1000 radii away, with depth stored in "
      "32, 24 and 16 bits: how the occlusion of its flat parts and of its crease changes. Truth: "
      "not at all.",
      "largest change of occlusion up to 100 R", 0.02, 0.25},
     makeTest<FarDepthTest>},
    {{"banding", "Tile banding",
      "Beside a crease, close by, far off and at a grazing angle, and among rods, occlusion is the "
      "same along the diagonals of the image; what repeats there every 3 or 4 pixels is the "
      "noise's "
      "tile, blur or not. Truth: none.",
      "RMS of the pattern of the noise tile", 0.002, 0.02},
     makeTest<BandingTest>},
};

} // namespace

std::span<const FailureTestRow> cameraTests() { return rows; }

} // namespace obscura
