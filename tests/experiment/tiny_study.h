#pragma once

#include "experiment/study.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura::test {

// A folder of its own for one test, removed with everything in it afterwards.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

// A complete study without a renderer: a protocol of seven conditions, noise for images, and the
// manifest that vouches for them.
struct TinyStudy {
    std::filesystem::path protocol, stimuli;
};

struct TinyOptions {
    double mask = 0.3; // seconds
    int width = 320, height = 180;
    double positionBias = 0;
    std::string simulation = {};                  // further lines of [simulation]
    std::string texts = {};                       // and of [texts]
    double minimumView = 0;                       // seconds
    std::string ordering = "scheme = \"thesis\""; // lines of [ordering]
    std::string conditions = {};                  // further lines of each of [[conditions]]
};

// Simulated preference for member b of each condition.
const std::vector<double>& tinyPreferences();

// Noise in place of every image that a protocol, any, wants rendered, and the manifest that vouches
// for it. Noise differs from image to image; its grains are a few pixels wide.
void writeNoiseStimuli(const Protocol& protocol, const std::filesystem::path& folder);

TinyStudy writeTinyStudy(const std::filesystem::path& folder, const TinyOptions& options = {});

} // namespace obscura::test
