#include "renderer/techniques/reduction.h"

#include <gtest/gtest.h>

namespace obscura {
namespace {

// A picked pixel looks along the same ray in both frames.
TEST(ReducedFrame, SeesPickedPixelsWhereTheyWere) {
    Camera camera;
    camera.position = {1, 2, 3};
    for (const int factor : {2, 3, 4})
        for (const glm::ivec2 size : {glm::ivec2(64, 48), glm::ivec2(61, 35)}) {
            const Frame full =
                makeFrame(camera, size.x, size.y, {{-1, -1, -1}, {1, 1, 1}}, 1, {0.2f, -0.3f});
            const Frame small = reducedFrame(full, factor);
            const auto direction = [](const Frame& frame, glm::vec2 pixel) {
                const glm::vec2 uv = (pixel + 0.5f) * glm::vec2(frame.size.z, frame.size.w);
                return uv * glm::vec2(frame.viewFromUv.x, frame.viewFromUv.y) +
                       glm::vec2(frame.viewFromUv.z, frame.viewFromUv.w);
            };
            const auto drawn = [](const Frame& frame, glm::vec2 at) { // pixel that it lands in
                const glm::vec4 clip = frame.clipFromView * glm::vec4(at * 5.0f, -5, 1);
                return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) *
                           glm::vec2(frame.size.x, frame.size.y) -
                       0.5f;
            };
            for (const glm::vec2 pixel : {glm::vec2(0), glm::vec2(7, 4)}) {
                const glm::vec2 picked =
                    pixel * static_cast<float>(factor) + static_cast<float>(factor / 2);
                const glm::vec2 expected = direction(full, picked);
                EXPECT_NEAR(glm::distance(direction(small, pixel), expected), 0, 1e-5);
                EXPECT_NEAR(glm::distance(drawn(full, expected), picked), 0, 1e-3);
                EXPECT_NEAR(glm::distance(drawn(small, expected), pixel), 0, 1e-3);
            }
            // A metre covers as many pixels of the full image as n times those of the small one.
            EXPECT_NEAR(full.depth.w * full.size.y,
                        static_cast<float>(factor) * small.depth.w * small.size.y, 1e-3);
        }
}

} // namespace
} // namespace obscura
