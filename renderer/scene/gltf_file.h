#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// A glTF 2.0 file, .gltf or .glb, with the bytes of all files that it names: checked, each read
// once, and hashed. Files may only lie in the scene's own folder or below it, and be regular files
// of at most 2 GiB; JSON may be nested 64 deep.
class GltfFile {
  public:
    // An Error where anything is wrong.
    explicit GltfFile(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    const nlohmann::json& root() const { return json_; }  // as gltf_check.h wants it
    const std::string& sha256() const { return sha256_; } // of the file and all that it names
    // The declared bytes of a buffer view, unpacked where they are compressed
    // (EXT_meshopt_compression); those are there after unpack() alone.
    std::span<const std::byte> view(std::size_t index) const { return views_[index]; }
    void unpack();
    // An image's encoded bytes, and the name of its file or of the image, for errors.
    std::span<const std::byte> image(std::size_t index) const;
    std::string imageName(std::size_t index) const;

    // All files that it names besides itself, canonical paths.
    std::vector<std::filesystem::path> named() const;

  private:
    using Bytes = std::span<const std::byte>;

    void parse(const std::string& text);
    void openBinary(const std::string& content, std::string& json);
    Bytes resolve(const std::string& uri, const std::string& jsonPath);
    Bytes decodeData(const std::string& uri, const std::string& jsonPath);
    Bytes readNamed(const std::string& uri, const std::string& jsonPath);
    void readBuffers();
    void readViews();
    void readImages();
    Bytes bytesOf(const nlohmann::json& part, const std::string& jsonPath) const;
    Bytes keep(std::string content);

    std::filesystem::path path_;
    nlohmann::json json_;
    std::vector<std::unique_ptr<const std::string>> kept_; // what the spans point into
    std::map<std::filesystem::path, Bytes> known_;         // files, by canonical path
    std::vector<Bytes> buffers_, views_, images_;
    Bytes binary_; // of a .glb
    bool hasBinary_ = false;
    std::vector<std::string> hashed_; // of each file read, in order
    std::string sha256_;
};

} // namespace obscura
