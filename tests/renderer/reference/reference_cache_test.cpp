#include "base/error.h"
#include "base/files.h"
#include "renderer/reference/reference_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace obscura {
namespace {

namespace fs = std::filesystem;

class ReferenceCache : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("obscura-cache-" + std::to_string(::getpid()));
        fs::remove_all(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    static Reference sample() {
        Reference reference{{3, 2, 1, {}}, {3, 2, 1, {}}, {3, 2, 3, {}}};
        for (int i = 0; i < 6; ++i) {
            reference.visibility.pixels.push_back(static_cast<float>(i) / 7);
            reference.error.pixels.push_back(static_cast<float>(i) / 700);
            for (int c = 0; c < 3; ++c)
                reference.bentNormal.pixels.push_back(static_cast<float>(i - 3 * c) / 11);
        }
        return reference;
    }
    Reference get() {
        return cachedReference(folder_, "key", [&] {
            ++traced_;
            return sample();
        });
    }
    fs::path file() const { return fs::directory_iterator(folder_)->path(); }

    fs::path folder_;
    int traced_ = 0;
};

TEST_F(ReferenceCache, TracesOnceAndKeepsEveryBit) {
    get();
    const Reference again = get();
    EXPECT_EQ(traced_, 1);
    EXPECT_EQ(again.visibility.pixels, sample().visibility.pixels);
    EXPECT_EQ(again.error.pixels, sample().error.pixels);
    EXPECT_EQ(again.bentNormal.pixels, sample().bentNormal.pixels);
    EXPECT_EQ(again.bentNormal.width, 3);
}

TEST_F(ReferenceCache, ABrokenFileIsTracedAnew) {
    get();
    const std::string whole = readFile(file());
    for (const std::string& broken :
         {std::string(), whole.substr(0, whole.size() / 2), whole.substr(0, whole.size() - 4),
          std::string("not an image")}) {
        writeFile(file(), broken);
        EXPECT_EQ(get().visibility.pixels, sample().visibility.pixels);
        EXPECT_EQ(readFile(file()), whole);
    }
    EXPECT_EQ(traced_, 5);
}

TEST_F(ReferenceCache, AFailedTraceLeavesNothing) {
    EXPECT_THROW(
        cachedReference(folder_, "key", []() -> Reference { throw Error("out of memory"); }),
        Error);
    EXPECT_TRUE(!fs::exists(folder_) || fs::is_empty(folder_));
}

TEST_F(ReferenceCache, KeysDifferWithEverything) {
    std::set<std::string> keys;
    const auto key = [&](const std::function<void(ReferenceInputs&)>& change) {
        ReferenceInputs inputs;
        inputs.width = 64;
        inputs.height = 48;
        change(inputs);
        keys.insert(referenceKey(inputs));
    };
    key([](ReferenceInputs&) {});
    key([](ReferenceInputs& i) { i.sceneSha256 = "other"; });
    key([](ReferenceInputs& i) { i.camera.position[1] += 1e-12; });
    key([](ReferenceInputs& i) { i.camera.target[1] += 1; });
    key([](ReferenceInputs& i) { i.camera.up[0] += 1; });
    key([](ReferenceInputs& i) { i.camera.fovDegrees += 1; });
    key([](ReferenceInputs& i) { i.camera.near = 0.1; });
    key([](ReferenceInputs& i) { i.width = 65; });
    key([](ReferenceInputs& i) { i.height = 49; });
    key([](ReferenceInputs& i) { i.jitter.x = 0.1f; });
    key([](ReferenceInputs& i) { i.normals = Normals::face; });
    key([](ReferenceInputs& i) { i.settings.integral = Integral::falloff; });
    key([](ReferenceInputs& i) { i.settings.radius *= 2; });
    key([](ReferenceInputs& i) { i.settings.rays *= 2; });
    key([](ReferenceInputs& i) { i.settings.seed += 1; });
    key([](ReferenceInputs& i) { i.settings.sameRays = true; });
    key([](ReferenceInputs& i) { i.code = "other"; });
    EXPECT_EQ(keys.size(), 17);
    key([](ReferenceInputs& i) { i.settings.threads = 1; });
    key([](ReferenceInputs& i) { i.settings.rays -= 1; }); // rounded up
    EXPECT_EQ(keys.size(), 17);
}

} // namespace
} // namespace obscura
