#include "tests/experiment/tiny_study.h"
#include "tests/foreign_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace obscura {
namespace {

TEST(PresenterProgram, ForeignFilesSurvive) {
    const test::TemporaryFolder root;
    const test::TinyStudy tiny = test::writeTinyStudy(root.path());
    const std::string study = readProtocol(tiny.protocol).name;
    const test::ForeignFiles data(root.path() / "data" / study), stimuli(tiny.stimuli);
    EXPECT_EQ(std::system(fmt::format("'{}/obscura-experiment' --protocol '{}' --stimuli '{}' "
                                      "--data '{}' --simulate 2 --seed 1 >/dev/null",
                                      OBSCURA_BIN, tiny.protocol.string(), tiny.stimuli.string(),
                                      (root.path() / "data").string())
                              .c_str()),
              0);
    EXPECT_EQ(data.lost(), "");
    EXPECT_EQ(stimuli.lost(), "");
}

} // namespace
} // namespace obscura
