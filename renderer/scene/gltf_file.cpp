#include "renderer/scene/gltf_file.h"

#include "base/error.h"
#include "base/files.h"
#include "renderer/scene/gltf_check.h"
#include "renderer/scene/gltf_meshopt.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>

namespace obscura {

namespace fs = std::filesystem;
using fmt::format;
using nlohmann::json;

namespace {

constexpr std::uintmax_t mostBytes = 0x7fffffff;
constexpr std::size_t mostUnpacked = std::size_t{1} << 32;
constexpr int deepest = 64;

std::string readWhole(const fs::path& path, const fs::path& scene, const std::string& jsonPath) {
    std::error_code problem;
    const fs::file_status status = fs::status(path, problem);
    if (!fs::exists(status))
        failGltf(scene, jsonPath, format("expected a file, found no {}", path.string()));
    if (!fs::is_regular_file(status)) // a device or a pipe never ends
        failGltf(scene, jsonPath, format("expected a regular file, {} is none", path.string()));
    if (const std::uintmax_t size = fs::file_size(path); size > mostBytes)
        failGltf(scene, jsonPath,
                 format("expected at most {} bytes, {} has {}", mostBytes, path.string(), size));
    return readFile(path);
}

std::uint32_t littleEndian(const std::string& content, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | static_cast<unsigned char>(content[at + i]);
    return value;
}

std::optional<std::string> percentDecoded(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            text += uri[i];
            continue;
        }
        const auto digit = [&](std::size_t at) {
            const char c = at < uri.size() ? uri[at] : ' ';
            return c >= '0' && c <= '9'   ? c - '0'
                   : c >= 'a' && c <= 'f' ? c - 'a' + 10
                   : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                          : -1;
        };
        const int high = digit(i + 1), low = digit(i + 2);
        if (high < 0 || low < 0)
            return std::nullopt;
        text += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return text;
}

std::optional<std::string> base64Decoded(std::string_view text) {
    static const auto values = [] {
        std::array<int, 256> table{};
        table.fill(-1);
        int value = 0;
        for (const char c : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                        "0123456789+/"))
            table[static_cast<unsigned char>(c)] = value++;
        return table;
    }();
    for (int pad = 0; pad < 2 && text.ends_with('='); ++pad)
        text.remove_suffix(1);
    if (text.size() % 4 == 1)
        return std::nullopt;
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int have = 0;
    for (const char c : text) {
        const int value = values[static_cast<unsigned char>(c)];
        if (value < 0)
            return std::nullopt;
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        have += 6;
        if (have >= 8) {
            have -= 8;
            bytes += static_cast<char>(bits >> have & 0xff);
        }
    }
    return bytes;
}

// Of a buffer or a view, what the extension says of its compression; null where nothing.
const json* packedOf(const json& object) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->contains("EXT_meshopt_compression"))
        return nullptr;
    return &extensions->at("EXT_meshopt_compression");
}

} // namespace

GltfFile::GltfFile(const fs::path& path) : path_(path) {
    if (!fs::exists(path))
        throw Error({path.string(), 0, 0, {}},
                    "expected a glTF scene, found no such file; name the "
                    "scenes folder by --scenes or OBSCURA_SCENES");
    std::string content = readWhole(path, path, "");
    hashed_.push_back(obscura::sha256(content));
    if (content.starts_with("glTF")) {
        std::string text;
        openBinary(content, text);
        parse(text);
    } else {
        parse(content);
    }
    checkGltf(json_, path_);
    readBuffers();
    readViews();
    readImages();
    Sha256 hash;
    for (const std::string& each : hashed_)
        hash.add(each);
    sha256_ = hash.hex();
}

std::vector<fs::path> GltfFile::named() const {
    std::vector<fs::path> files;
    for (const auto& [file, bytes] : known_)
        files.push_back(file);
    return files;
}

std::string GltfFile::imageName(std::size_t index) const {
    const json& image = json_.at("images")[index];
    const std::string uri = image.value("uri", "");
    return uri.empty() || uri.starts_with("data:") ? format("images[{}]", index) : uri;
}

// nlohmann's parser does not recurse, but all that is done to a value later does.
void GltfFile::parse(const std::string& text) {
    const auto guard = [&](int depth, json::parse_event_t, json&) {
        if (depth > deepest)
            failGltf(path_, "",
                     format("expected JSON nested at most {} deep, found deeper", deepest));
        return true;
    };
    try {
        json_ = json::parse(text, guard);
    } catch (const json::exception& error) {
        std::string reason = error.what();
        std::replace_if(
            reason.begin(), reason.end(), [](unsigned char c) { return c < 32 || c > 126; }, ' ');
        failGltf(path_, "",
                 format("expected the JSON of a glTF 2.0 file: {}", reason.substr(0, 200)));
    }
}

// glTF 2.0, section 4.4: a header of 12 bytes, then chunks of length, type and content.
void GltfFile::openBinary(const std::string& content, std::string& text) {
    const auto expect = [&](bool right, const std::string& expected, const std::string& found) {
        if (!right)
            failGltf(path_, "", format("expected {}, found {}", expected, found));
    };
    expect(content.size() >= 20, "a binary glTF file of at least 20 bytes",
           format("{}", content.size()));
    const std::uint32_t version = littleEndian(content, 4), length = littleEndian(content, 8);
    expect(version == 2, "binary glTF of version 2", format("version {}", version));
    expect(length <= content.size(), format("the {} bytes that its header declares", length),
           format("{}: the file is cut short", content.size()));
    std::size_t at = 12;
    for (int chunk = 0; at + 8 <= length; ++chunk) {
        const std::size_t size = littleEndian(content, at);
        const std::string type = content.substr(at + 4, 4);
        expect(size <= length - at - 8, format("a chunk within the {} bytes of the file", length),
               format("one of {} bytes from {}", size, at + 8));
        if (chunk == 0) {
            expect(type == "JSON", "a first chunk of JSON", "another");
            text = content.substr(at + 8, size);
        } else if (type == std::string("BIN\0", 4) && !hasBinary_) {
            binary_ = keep(content.substr(at + 8, size));
            hasBinary_ = true;
        }
        at += 8 + (size + 3) / 4 * 4;
    }
    expect(!text.empty(), "a chunk of JSON", "none");
}

GltfFile::Bytes GltfFile::keep(std::string content) {
    kept_.push_back(std::make_unique<const std::string>(std::move(content)));
    return std::as_bytes(std::span(*kept_.back()));
}

GltfFile::Bytes GltfFile::resolve(const std::string& uri, const std::string& jsonPath) {
    return uri.starts_with("data:") ? decodeData(uri, jsonPath) : readNamed(uri, jsonPath);
}

GltfFile::Bytes GltfFile::decodeData(const std::string& uri, const std::string& jsonPath) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64"))
        failGltf(path_, jsonPath,
                 format("expected data:TYPE;base64,..., found \"{}...\"", uri.substr(0, 40)));
    auto bytes = base64Decoded(std::string_view(uri).substr(comma + 1));
    if (!bytes)
        failGltf(path_, jsonPath,
                 format("expected base64 after \"{}\", found other letters, or a piece is missing",
                        uri.substr(0, std::min<std::size_t>(comma + 1, 60))));
    return keep(std::move(*bytes));
}

// A scene is its folder: what it names elsewhere could be anything on this machine.
GltfFile::Bytes GltfFile::readNamed(const std::string& uri, const std::string& jsonPath) {
    const auto name = percentDecoded(uri);
    const auto shown = [&] { return uri.substr(0, 80); };
    if (!name || name->find('\0') != std::string::npos)
        failGltf(path_, jsonPath, format("expected a relative URI, found \"{}\"", shown()));
    const std::size_t colon = name->find(':');
    if (colon != std::string::npos && colon > 1 && name->find_first_of("/\\") > colon)
        failGltf(
            path_, jsonPath,
            format("expected a file in the scene's folder, found the address \"{}\"", shown()));
    const fs::path folder = fs::weakly_canonical(fs::absolute(path_).parent_path());
    const fs::path file = fs::weakly_canonical(folder / fs::path(*name));
    const fs::path below = file.lexically_relative(folder);
    if (name->empty() || fs::path(*name).is_absolute() || below.empty() || *below.begin() == "..")
        failGltf(path_, jsonPath,
                 format("expected a file in the scene's folder or below it, found \"{}\"; copy it "
                        "there",
                        shown()));
    const auto known = known_.find(file);
    if (known != known_.end())
        return known->second;
    std::string content = readWhole(file, path_, jsonPath);
    hashed_.push_back(obscura::sha256(content));
    return known_[file] = keep(std::move(content));
}

void GltfFile::readBuffers() {
    const std::size_t count = json_.contains("buffers") ? json_.at("buffers").size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const json& buffer = json_.at("buffers")[i];
        const std::string at = format("buffers[{}]", i);
        const auto length = static_cast<std::size_t>(buffer.at("byteLength").get<double>());
        Bytes bytes;
        if (buffer.contains("uri"))
            bytes = resolve(buffer.at("uri").get<std::string>(), at + ".uri");
        else if (i == 0 && hasBinary_)
            bytes = binary_;
        else if (packedOf(buffer)) { // stands in for what is unpacked
            buffers_.push_back({});
            continue;
        } else
            failGltf(path_, at,
                     "expected a uri, found none; only the first buffer of a .glb can do without, "
                     "and one that compressed ones stand in for");
        if (bytes.size() < length)
            failGltf(path_, at + ".byteLength",
                     format("expected at most the {} bytes that are there, found {}", bytes.size(),
                            length));
        buffers_.push_back(bytes.first(length));
    }
}

GltfFile::Bytes GltfFile::bytesOf(const json& part, const std::string& jsonPath) const {
    const auto index = part.at("buffer").get<std::size_t>();
    const auto offset = static_cast<std::size_t>(part.value("byteOffset", 0.0)),
               length = static_cast<std::size_t>(part.at("byteLength").get<double>());
    if (buffers_[index].size() < offset + length)
        failGltf(path_, jsonPath + ".buffer",
                 format("expected a buffer with bytes, found buffers[{}], which has none", index));
    return buffers_[index].subspan(offset, length);
}

void GltfFile::readViews() {
    const std::size_t count = json_.contains("bufferViews") ? json_.at("bufferViews").size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const json& view = json_.at("bufferViews")[i];
        views_.push_back(packedOf(view) ? Bytes() : bytesOf(view, format("bufferViews[{}]", i)));
    }
}

void GltfFile::unpack() {
    std::size_t total = 0;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const json& view = json_.at("bufferViews")[i];
        const json* packed = packedOf(view);
        if (!packed)
            continue;
        const std::string at = format("bufferViews[{}].extensions.EXT_meshopt_compression", i);
        auto bytes = decodeMeshopt(*packed, bytesOf(*packed, at));
        if (!bytes)
            failGltf(path_, at,
                     format("expected a stream of {} of meshoptimizer, found another, or a damaged "
                            "one",
                            packed->at("mode").get<std::string>()));
        total += bytes->size();
        if (total > mostUnpacked)
            failGltf(path_, at,
                     format("expected at most {} bytes in all compressed views, found more",
                            mostUnpacked));
        views_[i] = keep(std::move(*bytes))
                        .first(static_cast<std::size_t>(view.at("byteLength").get<double>()));
    }
}

std::span<const std::byte> GltfFile::image(std::size_t index) const {
    const json& image = json_.at("images")[index];
    return image.contains("bufferView") ? view(image.at("bufferView").get<std::size_t>())
                                        : images_[index];
}

void GltfFile::readImages() {
    const std::size_t count = json_.contains("images") ? json_.at("images").size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const json& image = json_.at("images")[i];
        images_.push_back(image.contains("uri") ? resolve(image.at("uri").get<std::string>(),
                                                          format("images[{}].uri", i))
                                                : Bytes());
    }
}

} // namespace obscura
