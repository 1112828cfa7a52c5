#include "bench/failure_scenes.h"
#include "bench/failure_test.h"
#include "bench/tile_pattern.h"

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

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
    const Image& truth() const override { return views_.back().truth(); }

  private:
    static constexpr double distances[] = {2, 0.8, 0.4, 0.2, 0.1};
    static constexpr int runs = 5;
    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Selection> bands_;
};

// View depths as buffers of fewer bits return them.
struct DepthFormat {
    const char* name;
    Probe::StoredDepth stored;
};

constexpr float nearPlane = 0.1f; // of the 24-bit buffer, whose far plane is infinitely far

float halfFloat(float depth) { return glm::unpackHalf1x16(glm::packHalf1x16(depth)); }

// The usual direction, 0 at the near plane; reversing it changes nothing with whole numbers.
float fixedPoint24(float depth) {
    constexpr double steps = (1 << 24) - 1, near = static_cast<double>(nearPlane);
    const double stored = std::round((1 - near / static_cast<double>(depth)) * steps) / steps;
    return static_cast<float>(near / (1 - std::min(stored, 1 - 0.5 / steps)));
}

class FarDepthTest : public FailureTest {
  public:
    explicit FarDepthTest(ImageSize size) : scene_(creaseScene()) {
        const DepthFormat formats[] = {
            {"32-bit", {}}, {"24-bit", fixedPoint24}, {"16-bit float", halfFloat}};
        for (const DepthFormat& format : formats)
            for (const double distance : {3, 10, 100, 1000}) {
                views_.emplace_back(scene_, creaseCamera(distance, 3.6), size, format.stored);
                places_.push_back({fmt::format("{} at {} R", format.name, distance),
                                   creaseBand(views_.back(), 1.5f, 2.2f),
                                   creaseBand(views_.back(), 0.15f, 0.5f)});
            }
    }
    Finding measure(const TestedTechnique& technique) const override {
        Finding finding;
        double sum = 0, nearest = 0, worst = -1;
        std::string note;
        std::vector<double> creases;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Image image = technique.visibility(views_[i].probe());
            const double plane = meanOcclusion(image, places_[i].plane);
            nearest = i == 0 ? plane : nearest;
            creases.push_back(meanOcclusion(image, places_[i].crease));
            finding.measures.push_back({"plane, " + places_[i].name, plane});
            sum += std::abs(plane - nearest);
            if (std::abs(plane - nearest) > worst) {
                worst = std::abs(plane - nearest);
                note = "worst: " + places_[i].name;
                finding.picture = image;
                finding.expected = views_[i].truth();
            }
        }
        const double share = sum / static_cast<double>(places_.size() - 1);
        finding.measures.insert(finding.measures.begin(),
                                {"mean change of the plane's occlusion", share, note});
        finding.measures.push_back({"crease, 32-bit, 1000 R against 3 R", creases[3] - creases[0]});
        return finding;
    }
    const Image& truth() const override { return views_.front().truth(); }

  private:
    struct Place {
        std::string name;
        Selection plane, crease;
    };
    FailureScene scene_;
    std::deque<FailureView> views_;
    std::vector<Place> places_;
};

class BandingTest : public FailureTest {
  public:
    explicit BandingTest(ImageSize size)
        : scene_(creaseScene()), view_(scene_, creaseCamera(6, 2.7), size) {
        const double window = 0.2 * size.width;
        patch_ = view_.select([=](const SeenPoint& point) {
            return std::abs(static_cast<double>(point.pixelsAcross)) < window &&
                   fromCrease(point) > 0.2f && fromCrease(point) < 0.8f;
        });
    }
    Finding measure(const TestedTechnique& technique) const override {
        const Image image = technique.visibility(view_.probe());
        const Image expected = withRowsLevelled(image, patch_);
        Finding finding{{}, image, expected};
        TilePattern strongest;
        int tile = 0;
        for (const int period : {3, 4}) {
            const TilePattern pattern = tilePattern(image, expected, patch_, period);
            finding.measures.push_back(
                {fmt::format("share of energy, {} x {}", period, period), pattern.share});
            if (pattern.amplitude > strongest.amplitude) {
                strongest = pattern;
                tile = period;
            }
        }
        finding.measures.insert(
            finding.measures.begin(),
            {"RMS of the pattern of the noise tile", strongest.amplitude,
             tile ? fmt::format("{} x {} pixels, {:.0f} % of the grain's energy", tile, tile,
                                100 * strongest.share)
                  : "no grain"});
        return finding;
    }
    const Image& truth() const override { return view_.truth(); }

  private:
    FailureScene scene_;
    FailureView view_;
    Selection patch_;
};

const FailureTestRow rows[] = {
    {{"close", "Camera too close",
      "A crease from 2 radii away and from 0.1, where a radius is many screens wide: what becomes "
      "of the occlusion in it. Truth: nothing; negative is lost.",
      "change of occlusion in the crease on coming near", 0.05, 0.4},
     makeTest<CloseTest>},
    {{"far", "Far depth",
      "A right angle through longer and longer lenses, 3 to 1000 radii away, with depth stored in "
      "32, 24 and 16 bits: how the occlusion of its flat parts changes. Truth: not at all.",
      "mean change of the plane's occlusion", 0.02, 0.25},
     makeTest<FarDepthTest>},
    {{"banding", "Tile banding",
      "Beside a crease occlusion is the same along the edge; what repeats with a tile of 3 or 4 "
      "pixels there is the noise's, blur or not. Truth: none.",
      "RMS of the pattern of the noise tile", 0.004, 0.04},
     makeTest<BandingTest>},
};

} // namespace

std::span<const FailureTestRow> cameraTests() { return rows; }

} // namespace obscura
