// Published counts of votes, and the statistics of what is read.
#include "analysis/statistics.h"
#include "analysis/votes.h"
#include "tests/fuzz/fuzz.h"

using namespace obscura;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const FuzzFile file({reinterpret_cast<const char*>(data), size});
    readsOrRefuses([&] {
        for (const Tally& tally : readCounts(file.path()))
            if (tally.votes.total() > 0)
                for (const CountStatistic& statistic : countStatistics())
                    statistic.of(tally.votes);
    });
    return 0;
}
