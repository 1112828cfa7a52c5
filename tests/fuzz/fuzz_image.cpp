// libFuzzer: any bytes as an encoded image. The first byte chooses the format by its name.
#include "base/error.h"
#include "image/image.h"

#include <span>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace obscura;
    if (size < 1)
        return 0;
    static const std::string names[] = {"t.png", "t.jpg", "t", "t.bmp"};
    try {
        readImage8(std::as_bytes(std::span(data + 1, size - 1)), names[data[0] % 4], 4);
    } catch (const Error&) {
    }
    return 0;
}
