#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What every glTF error says: the file, the JSON path ("accessors[3].count"), then the message.
[[noreturn]] void failGltf(const std::filesystem::path& file, const std::string& jsonPath,
                           const std::string& message);

// What an extension adds to an object of a checked file; null where it adds nothing.
const nlohmann::json* extensionOf(const nlohmann::json& object, const char* name);

// What the checks of a glTF file's JSON are written with (gltf_check.h): a value of the expected
// kind at a key, or an Error that names file, JSON path, expected and found. `at` is the JSON path
// of the object that holds the key. An optional key that is missing gives nothing.
class GltfJson {
  public:
    using Json = nlohmann::json;
    // Whole numbers in JSON are exact up to here, and no file that we read is longer.
    static constexpr std::int64_t mostBytes = 0x7fffffff;

    GltfJson(const Json& root, const std::filesystem::path& file) : root_(root), file_(file) {}

    const Json& root() const { return root_; }
    static std::string join(const std::string& at, const std::string& key);
    [[noreturn]] void fail(const std::string& at, const std::string& message) const;
    [[noreturn]] void wrong(const std::string& at, const std::string& expected,
                            const Json& found) const;

    const Json* find(const Json& object, const char* key, const std::string& at,
                     bool required = false) const;
    const Json* object(const Json& parent, const char* key, const std::string& at) const;
    // What an extension adds to an object, at `extensions.NAME` there.
    const Json* extension(const Json& parent, const char* name, const std::string& at) const;
    static std::string extensionPath(const std::string& at, const char* name);

    std::optional<std::int64_t> whole(const Json& object, const char* key, const std::string& at,
                                      std::int64_t least, std::int64_t most,
                                      bool required = false) const;
    std::optional<double> number(const Json& object, const char* key, const std::string& at,
                                 double least, double most) const;
    std::vector<double> numbers(const Json& object, const char* key, const std::string& at,
                                std::size_t count) const;
    std::optional<std::string> text(const Json& object, const char* key,
                                    const std::string& at) const;
    void flag(const Json& object, const char* key, const std::string& at) const;
    void oneOf(const Json& object, const char* key, const std::string& at,
               const std::vector<Json>& allowed, bool required = false) const;

    // Indices into an array of the root, or into another.
    std::size_t sizeOf(const char* array) const;
    std::size_t index(const Json& value, const std::string& at, const char* array) const;
    std::size_t index(const Json& value, const std::string& at, const std::string& array,
                      std::size_t size) const;
    std::optional<std::size_t> index(const Json& object, const char* key, const std::string& at,
                                     const char* array, bool required = false) const;
    void indices(const Json& object, const char* key, const std::string& at,
                 const char* array) const;
    // Every object of an array of the root, or of any, with its path.
    using Check = std::function<void(const Json&, const std::string& at)>;
    void each(const char* array, const Check& check) const;
    void each(const Json& array, const std::string& at, const Check& check) const;

  private:
    double finite(const Json& value, const std::string& at) const;

    const Json& root_;
    const std::filesystem::path& file_;
};

} // namespace obscura
