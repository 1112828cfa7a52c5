// Published counts of votes, and the statistics of what is read.
#include "analysis/votes.h"
#include "tests/fuzz/fuzz.h"

using namespace obscura;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const FuzzFile file({reinterpret_cast<const char*>(data), size});
    readsOrRefuses([&] {
        for (const Tally& tally : readCounts(file.path()))
            frequencies(tally.votes);
    });
    return 0;
}
