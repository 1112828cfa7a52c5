// Every test program has a folder for temporary files of its own, gone when it ends: programs run
// side by side, as shards of one another and from several working copies.
#include <gmock/gmock.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace fs = std::filesystem;

int main(int argc, char** argv) {
    testing::InitGoogleMock(&argc, argv);
    std::string folder = (fs::temp_directory_path() / "obscura-tests-XXXXXX").string();
    if (!::mkdtemp(folder.data())) {
        std::perror(folder.c_str());
        return 1;
    }
    ::setenv("TMPDIR", folder.c_str(),
             1); // std::filesystem's, and that of programs which tests start
    ::setenv("TEST_TMPDIR", folder.c_str(), 1); // GoogleTest's
    const int result = RUN_ALL_TESTS();
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    return result;
}
