#include "base/files.h"
#include "bench/choose/report.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Nothing is chosen: an earlier answer of ours goes, one that a person wrote is kept.
TEST(ChooseReport, AChoiceThatAPersonWroteSurvives) {
    const test::Folder root;
    EXPECT_NO_THROW(requireOwnChoice(root.path()));
    const std::string mine = "[techniques.mine]\ntechnique = \"crytek\"\n";
    writeFile(root / "choice.toml", mine);
    EXPECT_THAT(test::errorOf([&] { requireOwnChoice(root.path()); }),
                HasSubstr("choice.toml: expected a choice that obscura-bench choose wrote"));
    EXPECT_THROW(writeChoice(root.path(), {}, {}, {}), Error);
    EXPECT_EQ(readFile(root / "choice.toml"), mine);

    writeFile(root / "elsewhere.toml", mine);
    fs::remove(root / "choice.toml");
    fs::create_symlink(root / "elsewhere.toml", root / "choice.toml");
    EXPECT_THROW(requireOwnChoice(root.path()), Error);
    EXPECT_THROW(writeChoice(root.path(), {}, {}, {}), Error);
    EXPECT_TRUE(fs::is_symlink(root / "choice.toml"));
}

} // namespace
} // namespace obscura
