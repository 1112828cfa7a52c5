#include "tests/analysis/sample_study.h"
#include "tests/foreign_files.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace obscura {
namespace {

TEST(AnalysisProgram, ForeignFilesSurvive) {
    const test::Folder root;
    test::writeStudy(root / "study", 6);
    const test::ForeignFiles beside(root / "out"), within(root / "study");
    for (int run = 0; run < 2; ++run)
        EXPECT_EQ(
            std::system(fmt::format("'{}/obscura-analysis' '{}' --out '{}' >/dev/null 2>&1",
                                    OBSCURA_BIN, (root / "study").string(), (root / "out").string())
                            .c_str()),
            0);
    EXPECT_EQ(beside.lost(), "");
    EXPECT_EQ(within.lost(), "");
}

} // namespace
} // namespace obscura
