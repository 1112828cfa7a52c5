#include "bench/failure_scenes.h"
#include "bench/failure_test.h"
#include "bench/stored_depth.h"
#include "bench/tile_pattern.h"

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
        Finding finding;
        std::vector<double> found;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            finding.picture = technique.visibility(views_[i].probe());
            found.push_back(meanOcclusion(finding.picture, bands_[i]));
            finding.measures.push_back(
                {fmt::format("occlusion from {} R away", distances[i]), found.back()});
        }
        finding.expected = views_.back().truth();
        finding.measures.insert(
            finding.measures.begin(),
            {"change of occlusion in the crease on coming near", found.back() - found.front()});
        finding.measures.push_back({"time near / far",
                                    technique.seconds(views_.back().probe(), runs) /
                                        technique.seconds(views_.front().probe(), runs),
                                    "wall time on this machine, read-back included"});
        return finding;
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
            {"32-bit", {}}, {"24-bit", fixedPointDepth}, {"16-bit float", halfFloatDepth}};
        for (const auto& [name, stored] : formats)
            for (const double distance : {5, 10, 100, 1000}) {
                views_.emplace_back(scene_, creaseCamera(distance, 5.2), size, stored);
                places_.push_back({fmt::format("{} at {} R", name, distance),
                                   creaseBand(views_.back(), 1.5f, 2.2f),
                                   creaseBand(views_.back(), 0.15f, 0.5f), distance <= 100});
            }
    }
    Finding measure(const TestedTechnique& technique) const override {
        std::vector<Measured> measures;
        Worst worst;
        double nearPlane = 0, nearCrease = 0;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Place& at = places_[i];
            const Image image = technique.visibility(views_[i].probe());
            const double plane = meanOcclusion(image, at.plane);
            const double crease = meanOcclusion(image, at.crease);
            measures.push_back({"plane, " + at.name, plane});
            measures.push_back({"crease, " + at.name, crease});
            nearPlane = i == 0 ? plane : nearPlane;
            nearCrease = i == 0 ? crease : nearCrease;
            if (!at.counts)
                continue;
            worst.offer(plane - nearPlane, "plane, " + at.name, image, i);
            worst.offer(crease - nearCrease, "crease, " + at.name, image, i);
        }
        measures.insert(measures.begin(),
                        {"largest change of occlusion up to 100 R", worst.value, worst.where});
        return {measures, worst.picture, views_[worst.index].truth()};
    }
    const FailureView& view() const override { return views_.front(); }

  private:
    struct Place {
        std::string name;
        Selection plane, crease;
        bool counts; // farther away fewer bits leave nothing of any scene
    };
    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Place> places_;
};

class BandingTest : public FailureTest {
  public:
    explicit BandingTest(ImageSize size) : scene_(creaseScene()) {
        const double window = 0.3 * size.width;
        for (const Sight& sight : sights) {
            const FailureView& view =
                views_.emplace_back(scene_, creaseCamera(6, sight.height, sight.degrees), size);
            patches_.push_back(view.select([=](const SeenPoint& point) {
                return std::abs(static_cast<double>(point.pixelsAcross)) < window &&
                       fromCrease(point) > 0.2f && fromCrease(point) < 0.8f;
            }));
        }
    }
    Finding measure(const TestedTechnique& technique) const override {
        std::vector<Measured> measures;
        Worst worst;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const Image image = technique.visibility(views_[i].probe());
            const Image levelled = withRowsLevelled(image, patches_[i]);
            for (const int period : {3, 4}) {
                const TilePattern found = tilePattern(image, levelled, patches_[i], period);
                const std::string name = fmt::format("{} x {}, {}", period, period, sights[i].name);
                worst.offer(found.amplitude, name, image, i);
                measures.push_back({"RMS, " + name, found.amplitude});
                measures.push_back({"share of the grain's energy, " + name, found.share});
            }
        }
        measures.insert(measures.begin(),
                        {"RMS of the pattern of the noise tile", worst.value, worst.where});
        return {measures, worst.picture, withRowsLevelled(worst.picture, patches_[worst.index])};
    }
    const FailureView& view() const override { return views_.front(); }

  private:
    struct Sight {
        const char* name;
        double height, degrees;
    };
    static constexpr Sight sights[] = {
        {"close by", 2.7, 45}, {"farther", 10, 45}, {"floor at 80°", 2.7, 10}};
    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Selection> patches_;
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
      "Beside a crease occlusion is the same along the edge; what repeats with a tile of 3 or 4 "
      "pixels there is the noise's, blur or not: close by, farther, and with the floor at a "
      "grazing angle. Truth: none.",
      "RMS of the pattern of the noise tile", 0.004, 0.04},
     makeTest<BandingTest>},
};

} // namespace

std::span<const FailureTestRow> cameraTests() { return rows; }

} // namespace obscura
