#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace obscura::test {

// Zip files byte by byte, as PKWARE's APPNOTE.TXT has them (4.3.7, 4.3.12, 4.3.16), so that they
// can say what no library would let them.
struct ZipEntry {
    std::string name;
    std::string content = "content\n"; // as it lies in the file
    std::uint32_t unixMode = 0100644;
    std::uint16_t method = 0, flags = 0;
    std::uint32_t size = 0xffffffff; // declared; by default the true one of stored content
    std::uint32_t crc = 0;           // 0: that of the content
};

inline std::uint32_t crc32Of(const std::string& text) {
    std::uint32_t crc = 0xffffffff;
    for (const unsigned char byte : text) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

// DEFLATE without compression: one last block, stored (RFC 1951, 3.2.4). Up to 65535 bytes.
inline std::string deflatedOf(const std::string& text) {
    const auto size = static_cast<std::uint16_t>(text.size());
    std::string bytes = "\x01";
    for (const std::uint16_t word : {size, static_cast<std::uint16_t>(~size)}) {
        bytes += static_cast<char>(word & 0xff);
        bytes += static_cast<char>(word >> 8);
    }
    return bytes + text;
}

inline std::string zipBytes(const std::vector<ZipEntry>& entries) {
    std::string bytes, directory;
    const auto number = [](std::string& to, std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i)
            to += static_cast<char>(value >> 8 * i & 0xff);
    };
    for (const ZipEntry& entry : entries) {
        const std::uint32_t size = entry.size == 0xffffffff
                                       ? static_cast<std::uint32_t>(entry.content.size())
                                       : entry.size;
        const std::size_t offset = bytes.size();
        const auto common = [&](std::string& to) { // of both headers
            number(to, 20, 2);                     // version needed
            number(to, entry.flags, 2);
            number(to, entry.method, 2);
            number(to, 0, 2);      // time
            number(to, 0x0021, 2); // date: 1980-01-01
            number(to, entry.crc ? entry.crc : crc32Of(entry.content), 4);
            number(to, entry.content.size(), 4);
            number(to, size, 4);
            number(to, entry.name.size(), 2);
            number(to, 0, 2); // extra
        };
        number(bytes, 0x04034b50, 4);
        common(bytes);
        bytes += entry.name + entry.content;
        number(directory, 0x02014b50, 4);
        number(directory, 3 << 8 | 20, 2); // made on Unix
        common(directory);
        number(directory, 0, 2); // comment
        number(directory, 0, 2); // disk
        number(directory, 0, 2); // internal attributes
        number(directory, std::uint64_t{entry.unixMode} << 16, 4);
        number(directory, offset, 4);
        directory += entry.name;
    }
    const std::size_t start = bytes.size();
    bytes += directory;
    number(bytes, 0x06054b50, 4);
    number(bytes, 0, 4); // disks
    number(bytes, entries.size(), 2);
    number(bytes, entries.size(), 2);
    number(bytes, directory.size(), 4);
    number(bytes, start, 4);
    number(bytes, 0, 2);
    return bytes;
}

} // namespace obscura::test
