#include "report/html.h"

#include <openssl/evp.h>

namespace obscura {

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    return result;
}

std::string dataAddress(std::string_view mediaType, std::string_view bytes) {
    std::string base64(4 * ((bytes.size() + 2) / 3) + 1, '\0'); // and a terminator
    EVP_EncodeBlock(reinterpret_cast<unsigned char*>(base64.data()),
                    reinterpret_cast<const unsigned char*>(bytes.data()),
                    static_cast<int>(bytes.size()));
    base64.pop_back();
    return "data:" + std::string(mediaType) + ";base64," + base64;
}

} // namespace obscura
