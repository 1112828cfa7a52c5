// Participants' answers. Rows that are read are written and read again.
#include "protocols/reader/responses.h"
#include "tests/fuzz/fuzz.h"

using namespace obscura;

namespace {

std::string written(const ResponseFile& file) {
    std::string text = responseHeader();
    for (const Response& row : file.rows)
        text += responseLine(row);
    return text;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const FuzzFile file({reinterpret_cast<const char*>(data), size});
    readsOrRefuses([&] { readResponses(file.path(), false); });
    readsOrRefuses([&] {
        const std::string once = written(readResponses(file.path(), true));
        const FuzzFile copy(once);
        const ResponseFile again = readResponses(copy.path(), false); // an Error here is a finding
        if (written(again) != once)
            std::abort();
    });
    return 0;
}
