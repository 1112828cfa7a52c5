#include "image/canvas.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>

namespace obscura {
namespace {

using testing::HasSubstr;

TEST(Canvas, RefusesWhatCairoCannotDraw) {
    EXPECT_THAT(test::errorOf([] { Canvas(100, 32768); }), HasSubstr("found 100 x 32768"));
    EXPECT_THAT(test::errorOf([] { Canvas(40000, 100); }), HasSubstr("found 40000 x 100"));
    EXPECT_THAT(test::errorOf([] { Canvas(0, 100); }), HasSubstr("found 0 x 100"));
    EXPECT_EQ(Canvas(2, 32767).finish().pixels.size(), 2u * 32767u * 3u);
}

TEST(Pages, HoldEveryRowOnce) {
    for (const std::size_t rows : {0u, 1u, 51u, 52u, 107u, 1000u}) {
        std::size_t next = 0;
        for (const PageRows& page : pagesOf(rows, 306, 108)) {
            EXPECT_EQ(page.first, next);
            EXPECT_LE(108 + 306 * (page.last - page.first), 16000u);
            next = page.last;
        }
        EXPECT_EQ(next, rows);
    }
    EXPECT_EQ(pagesOf(51, 306, 108).size(), 1u);
    EXPECT_EQ(pagesOf(52, 306, 108).size(), 2u);
    EXPECT_EQ(pagesOf(3, 20000, 108).size(), 3u); // a row is never cut
}

TEST(Pages, AreNumberedOnlyWhereThereAreSeveral) {
    EXPECT_EQ(pageName("match", 0, 1), "match.png");
    EXPECT_EQ(pageName("match", 1, 3), "match-2.png");
}

} // namespace
} // namespace obscura
