#include "base/files.h"
#include "experiment/append_file.h"
#include "tests/folder.h"
#include "tests/lossy_disk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace obscura {
namespace {

// A row that was appended has been answered by a person: it must outlive a power cut at once, and
// so must the file and the folders that hold it.
TEST(AppendFileTest, APowerCutLosesNoRow) {
    const test::Folder root;
    const test::LossyDisk disk(root.path());
    AppendFile rows = AppendFile::create(root / "study/data/rows.csv");
    rows.append("a,b\n");
    EXPECT_EQ(disk.left()["study/data/rows.csv"], "a,b\n");
    rows.append("1,2\n3,4\n");
    EXPECT_EQ(disk.left()["study/data/rows.csv"], "a,b\n1,2\n3,4\n");
    AppendFile ledger = AppendFile::openLocked(root / "study/sessions/ledger.jsonl");
    ledger.append("{}\n");
    EXPECT_EQ(disk.left()["study/sessions/ledger.jsonl"], "{}\n");
}

} // namespace
} // namespace obscura
