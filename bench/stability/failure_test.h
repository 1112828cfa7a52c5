#pragma once

#include "bench/measure/tested_technique.h"
#include "bench/stability/cell.h"
#include "bench/stability/failure_view.h"

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// What a test finds about one technique.
struct Finding {
    double value = 0;                  // the headline
    std::string note = {};             // StabilityCell::note
    Image picture = {}, expected = {}; // visibility where that is, and as it should be
    struct Measure {
        std::string name; // words
        double value = 0;
        std::string note = {};
    };
    std::vector<Measure> others = {};
};

// Of all images of a test, the one that is furthest from what it should be.
struct Worst {
    double value = 0;
    std::string where = {};
    Image picture = {};
    std::size_t index = 0;

    void offer(double found, const std::string& place, const Image& image, std::size_t at) {
        if (picture.pixels.empty() || std::abs(found) > std::abs(value))
            *this = {found, found == 0 ? "" : place, image, at};
    }
};

// A failure test whose scenes are built and drawn, for techniques to take one after the other.
class FailureTest {
  public:
    virtual ~FailureTest() = default;
    virtual Finding measure(const TestedTechnique& technique) const = 0;
    // A view that shows what the test is about.
    virtual const FailureView& view() const = 0;
};

struct FailureTestRow {
    StabilityTest about;
    std::unique_ptr<FailureTest> (*make)(ImageSize size);
};
template <typename Test>
std::unique_ptr<FailureTest> makeTest(ImageSize size) {
    return std::make_unique<Test>(size);
}

// Where nothing should be dark: planes, convex edges, walls far behind things.
std::span<const FailureTestRow> openTests();
// Where occluders are thin, hidden or seen at a grazing angle.
std::span<const FailureTestRow> occluderTests();
// What depends on the camera: nearness, distance, the noise tile on its screen.
std::span<const FailureTestRow> cameraTests();
// What should make no difference and does: borders, resolution, roll and scale.
std::span<const FailureTestRow> invarianceTests();

} // namespace obscura
