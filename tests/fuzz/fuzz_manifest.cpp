// The stimuli's manifest.
#include "protocols/reader/manifest.h"
#include "tests/fuzz/fuzz.h"

using namespace obscura;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const FuzzFile file({reinterpret_cast<const char*>(data), size});
    readsOrRefuses([&] {
        for (const ConditionRecord& condition : readManifest(file.path()).conditions) {
            for (const ImageRecord& image : condition.images)
                image.recipe.json();
        }
    });
    return 0;
}
