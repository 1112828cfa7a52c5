#include "renderer/scene/gltf_json.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

using fmt::format;

namespace {

// Nothing in a scene is further away, and no product of two such numbers overflows a float.
constexpr double largest = 1e15;

// What stands at a place, short enough for a line.
std::string spelt(const nlohmann::json& value) {
    std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return text.size() > 40 ? text.substr(0, 40) + "..." : text;
}

} // namespace

const nlohmann::json* extensionOf(const nlohmann::json& object, const char* name) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end())
        return nullptr;
    const auto found = extensions->find(name);
    return found == extensions->end() ? nullptr : &*found;
}

void failGltf(const std::filesystem::path& file, const std::string& jsonPath,
              const std::string& message) {
    throw Error({file.string(), 0, 0, jsonPath}, message);
}

std::string GltfJson::join(const std::string& at, const std::string& key) {
    return at.empty() ? key : at + "." + key;
}

void GltfJson::fail(const std::string& at, const std::string& message) const {
    failGltf(file_, at, message);
}

void GltfJson::wrong(const std::string& at, const std::string& expected, const Json& found) const {
    fail(at, format("expected {}, found {}", expected, spelt(found)));
}

const nlohmann::json* GltfJson::find(const Json& object, const char* key, const std::string& at,
                                     bool required) const {
    const auto found = object.find(key);
    if (found != object.end())
        return &*found;
    if (required)
        fail(at.empty() ? "(root)" : at, format("expected \"{}\", found none", key));
    return nullptr;
}

const nlohmann::json* GltfJson::object(const Json& parent, const char* key,
                                       const std::string& at) const {
    const Json* value = find(parent, key, at);
    if (value && !value->is_object())
        wrong(join(at, key), "an object", *value);
    return value;
}

std::string GltfJson::extensionPath(const std::string& at, const char* name) {
    return join(join(at, "extensions"), name);
}

const nlohmann::json* GltfJson::extension(const Json& parent, const char* name,
                                          const std::string& at) const {
    const Json* extensions = object(parent, "extensions", at);
    return extensions ? object(*extensions, name, join(at, "extensions")) : nullptr;
}

std::optional<std::int64_t> GltfJson::whole(const Json& object, const char* key,
                                            const std::string& at, std::int64_t least,
                                            std::int64_t most, bool required) const {
    const Json* value = find(object, key, at, required);
    if (!value)
        return std::nullopt;
    // Some writers say 3.0.
    const bool isWhole =
        value->is_number() && std::floor(value->get<double>()) == value->get<double>();
    if (!isWhole || value->get<double>() < static_cast<double>(least) ||
        value->get<double>() > static_cast<double>(most))
        wrong(join(at, key), format("a whole number from {} to {}", least, most), *value);
    return static_cast<std::int64_t>(value->get<double>());
}

double GltfJson::finite(const Json& value, const std::string& at) const {
    if (!value.is_number() || !(std::abs(value.get<double>()) <= largest))
        wrong(at, format("a number within {:g}", largest), value);
    return value.get<double>();
}

std::optional<double> GltfJson::number(const Json& object, const char* key, const std::string& at,
                                       double least, double most) const {
    const Json* value = find(object, key, at);
    if (!value)
        return std::nullopt;
    const double found = finite(*value, join(at, key));
    if (found < least || found > most)
        wrong(join(at, key), format("a number from {:g} to {:g}", least, most), *value);
    return found;
}

std::vector<double> GltfJson::numbers(const Json& object, const char* key, const std::string& at,
                                      std::size_t count) const {
    const Json* value = find(object, key, at);
    if (!value)
        return {};
    if (!value->is_array() || value->size() != count)
        wrong(join(at, key), format("{} numbers", count), *value);
    std::vector<double> result;
    for (const Json& item : *value)
        result.push_back(finite(item, join(at, key)));
    return result;
}

std::optional<std::string> GltfJson::text(const Json& object, const char* key,
                                          const std::string& at) const {
    const Json* value = find(object, key, at);
    if (!value)
        return std::nullopt;
    if (!value->is_string())
        wrong(join(at, key), "text", *value);
    return value->get<std::string>();
}

void GltfJson::flag(const Json& object, const char* key, const std::string& at) const {
    const Json* value = find(object, key, at);
    if (value && !value->is_boolean())
        wrong(join(at, key), "true or false", *value);
}

void GltfJson::oneOf(const Json& object, const char* key, const std::string& at,
                     const std::vector<Json>& allowed, bool required) const {
    const Json* value = find(object, key, at, required);
    if (!value || std::find(allowed.begin(), allowed.end(), *value) != allowed.end())
        return;
    std::string names;
    for (const Json& each : allowed)
        names += (names.empty() ? "" : ", ") +
                 (each.is_string() ? each.get<std::string>() : spelt(each));
    wrong(join(at, key), "one of " + names, *value);
}

std::size_t GltfJson::sizeOf(const char* array) const {
    const auto found = root_.find(array);
    return found == root_.end() ? 0 : found->size();
}

std::size_t GltfJson::index(const Json& value, const std::string& at, const std::string& array,
                            std::size_t size) const {
    if (!value.is_number_integer() || value.get<double>() < 0 ||
        value.get<double>() >= static_cast<double>(size))
        wrong(at,
              size == 0 ? format("an index into {}, of which there are none", array)
                        : format("an index into {}, 0 to {}", array, size - 1),
              value);
    return value.get<std::size_t>();
}

std::size_t GltfJson::index(const Json& value, const std::string& at, const char* array) const {
    return index(value, at, array, sizeOf(array));
}

std::optional<std::size_t> GltfJson::index(const Json& object, const char* key,
                                           const std::string& at, const char* array,
                                           bool required) const {
    const Json* value = find(object, key, at, required);
    return value ? std::optional(index(*value, join(at, key), array)) : std::nullopt;
}

void GltfJson::indices(const Json& object, const char* key, const std::string& at,
                       const char* array) const {
    const Json* value = find(object, key, at);
    if (!value)
        return;
    if (!value->is_array())
        wrong(join(at, key), format("an array of indices into {}", array), *value);
    for (std::size_t i = 0; i < value->size(); ++i)
        index((*value)[i], format("{}[{}]", join(at, key), i), array);
}

void GltfJson::each(const Json& array, const std::string& at, const Check& check) const {
    if (!array.is_array())
        wrong(at, "an array", array);
    for (std::size_t i = 0; i < array.size(); ++i) {
        const std::string path = format("{}[{}]", at, i);
        if (!array[i].is_object())
            wrong(path, "an object", array[i]);
        check(array[i], path);
    }
}

void GltfJson::each(const char* array, const Check& check) const {
    if (const Json* found = find(root_, array, ""))
        each(*found, array, check);
}

} // namespace obscura
