#pragma once

#include "renderer/scene/gltf_file.h"

#include <array>
#include <optional>
#include <string>

namespace obscura {

// An object of a glTF file with its place there, to read what gltf_check.h leaves unchecked:
// extensions. A value of the wrong kind, or out of its range, is an Error that says where it is.
class GltfObject {
  public:
    // `value` is an object of the file and lives as long as it does.
    GltfObject(const GltfFile& file, const nlohmann::json& value, std::string path);

    const std::string& path() const { return path_; }

    // Nothing where the key is missing.
    std::optional<GltfObject> object(const char* key) const;
    std::optional<GltfObject> extension(const char* name) const;

    double number(const char* key, double low, double high, double absent) const;
    int whole(const char* key, int low, int high, int absent) const;
    bool flag(const char* key) const; // false where it is missing
    std::string text(const char* key, const std::string& absent = "") const;
    // An index into an array of the file's root.
    std::optional<int> index(const char* key, const char* array) const;

    // As many numbers as `absent` has, each from `low` to `high`.
    template <std::size_t N>
    std::array<float, N> numbers(const char* key, double low, double high,
                                 std::array<float, N> absent) const {
        for (std::size_t i = 0; i < N; ++i)
            absent[i] = static_cast<float>(component(key, i, N, low, high, absent[i]));
        return absent;
    }

  private:
    const nlohmann::json* find(const char* key) const;
    [[noreturn]] void wrong(const std::string& key, const std::string& expected,
                            const nlohmann::json& found) const;
    double component(const char* key, std::size_t i, std::size_t count, double low, double high,
                     double absent) const;
    double checked(const nlohmann::json& value, const std::string& key, double low,
                   double high) const;

    const GltfFile* file_;
    const nlohmann::json* value_;
    std::string path_;
};

} // namespace obscura
