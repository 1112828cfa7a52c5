// The ledger of slots.
#include "experiment/ledger.h"
#include "tests/fuzz/fuzz.h"

using namespace obscura;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const FuzzFile file({reinterpret_cast<const char*>(data), size});
    readsOrRefuses([&] {
        for (const SlotRecord& record : Ledger(file.path()).records())
            isOrphan(record);
    });
    return 0;
}
