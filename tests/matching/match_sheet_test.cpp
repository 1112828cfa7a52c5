#include "matching/match_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace obscura {
namespace {

// A sweep of 107 configurations on views of 32 x 270 pixels made a sheet of 32,850 pixels and
// crashed when all matching was done.
TEST(MatchSheet, OfManyTechniquesHasSeveralPages) {
    const Image view{32, 270, 1, std::vector<float>(32 * 270, 0.5F)};
    const std::vector<MatchPictures> techniques(107, {"name <b> & more", view, view});
    const std::vector<Image8> pages = matchSheet("many", view, techniques);
    ASSERT_EQ(pages.size(), 3u);
    for (const Image8& page : pages) {
        EXPECT_LE(page.height, 16000);
        const std::size_t middle = page.pixels.size() / 2;
        EXPECT_NE(*std::min_element(page.pixels.begin() + static_cast<std::ptrdiff_t>(middle),
                                    page.pixels.end()),
                  255); // there is something on it
    }
}

TEST(MatchSheet, ShrinksViewsThatAreHigherThanWide) {
    const Image view{100, 20000, 1, std::vector<float>(100 * 20000, 0.5F)};
    EXPECT_LE(matchSheet("tower", view, {{"one", view, view}}).front().height, 16000);
}

} // namespace
} // namespace obscura
