#include "bench/motion/temporal_tests.h"

#include "base/error.h"
#include "bench/motion/camera_path.h"

#include <fmt/format.h>

#include <vector>

namespace obscura {

namespace {

constexpr std::string_view unreal = "unreal change, mean";
// What passes and what fails. The former is the change that sampling once per pixel makes even of
// the truth at these sizes, the latter a change that nobody overlooks.
constexpr double steady = 0.01, restless = 0.03;
// What passes at a cut, a jump half-way to what is seen. There everything that `none` lacks changes
// at once; it reads 0.019.
constexpr double jumped = 0.025;

constexpr TemporalTest table[] = {
    {{"still", "Flicker, camera still",
      "The camera keeps still, and the seed of the noise changes with every frame: standard "
      "deviation of each pixel over the frames. Picture: the last frame, and the deviation, 8 "
      "times "
      "as strong.",
      "deviation over frames, mean", 0.002, 0.02},
     [](const Camera& start, int, int) { return start; },
     true},
    {{"dolly", "Flicker, dolly",
      "The camera moves towards its target by 1/400 of the distance a frame. Unreal change: of the "
      "visibility of a point on a surface from one frame to the next, less the change of the "
      "ray-traced truth, fetched in the same way. Picture: the worst frame, the truth, and the "
      "mean "
      "unreal change, 8 times as strong.",
      unreal, steady, restless},
     dollied,
     false},
    {{"orbit", "Flicker, orbit",
      "The camera goes round its target by 0.2 degrees a frame; measured as on the dolly.", unreal,
      steady, restless},
     orbited,
     false},
    {{"turn", "Flicker, turn",
      "The camera turns on the spot by 0.1 degrees a frame; measured as on the dolly.", unreal,
      steady, restless},
     turned,
     false},
    {{"cut", "Change at a cut",
      "A still camera jumps half-way to its target, once; measured as on the dolly, at the jump, "
      "for points that both views show.",
      unreal, jumped, 2 * jumped},
     cut,
     false},
};

} // namespace

std::span<const TemporalTest> temporalTests() { return table; }

const TemporalTest& temporalTest(const std::string& id) {
    std::vector<std::string_view> ids;
    for (const TemporalTest& row : table) {
        if (row.test.id == id)
            return row;
        ids.push_back(row.test.id);
    }
    throw Error(
        fmt::format("expected a temporal test ({}), found \"{}\"", fmt::join(ids, ", "), id));
}

} // namespace obscura
