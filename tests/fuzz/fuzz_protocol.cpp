// A study's protocol, and the other files that are written by hand in TOML.
#include "protocols/reader/match.h"
#include "protocols/reader/protocol.h"
#include "protocols/reader/sweep.h"
#include "tests/fuzz/fuzz.h"

using namespace obscura;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    readsOrRefuses([&] { parseProtocol(text, "fuzz.toml"); });
    return 0;
}
