#pragma once

#include "experiment/study.h"
#include "tests/experiment/tiny_study.h"

#include <gtest/gtest.h>

namespace obscura::test {

// A small study, and where the presenter that is started for it on a small screen puts its data and
// what it says.
class PresentedStudy : public testing::Test {
  protected:
    static constexpr int width = 640, height = 400; // of the screen

    TemporaryFolder folder;
    std::filesystem::path data = folder.path() / "data", output = folder.path() / "output.txt";
    Study study;

    void open(const TinyOptions& options) {
        const TinyStudy tiny = writeTinyStudy(folder.path(), options);
        study = openStudy(tiny.protocol, tiny.stimuli);
    }
    std::vector<std::string> arguments(std::vector<std::string> more = {}) {
        std::vector<std::string> all = {"--protocol", study.protocol.path.string(),
                                        "--stimuli",  study.manifest.folder.string(),
                                        "--data",     data.string()};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

} // namespace obscura::test
