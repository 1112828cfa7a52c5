#include "renderer/scene/gltf_object.h"

#include "renderer/scene/gltf_check.h"

#include <fmt/format.h>

#include <cmath>

namespace obscura {

using fmt::format;
using nlohmann::json;

GltfObject::GltfObject(const GltfFile& file, const json& value, std::string path)
    : file_(&file), value_(&value), path_(std::move(path)) {}

const json* GltfObject::find(const char* key) const {
    const auto found = value_->find(key);
    return found == value_->end() ? nullptr : &*found;
}

void GltfObject::wrong(const std::string& key, const std::string& expected,
                       const json& found) const {
    const std::string text = found.dump(-1, ' ', false, json::error_handler_t::replace);
    failGltf(file_->path(), path_ + "." + key,
             format("expected {}, found {}", expected,
                    text.size() > 40 ? text.substr(0, 40) + "..." : text));
}

std::optional<GltfObject> GltfObject::object(const char* key) const {
    const json* found = find(key);
    if (!found)
        return std::nullopt;
    if (!found->is_object())
        wrong(key, "an object", *found);
    return GltfObject(*file_, *found, path_ + "." + key);
}

std::optional<GltfObject> GltfObject::extension(const char* name) const {
    const auto extensions = object("extensions");
    return extensions ? extensions->object(name) : std::nullopt;
}

double GltfObject::checked(const json& value, const std::string& key, double low,
                           double high) const {
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= low && number <= high))
        wrong(key, format("a number from {:g} to {:g}", low, high), value);
    return number;
}

double GltfObject::number(const char* key, double low, double high, double absent) const {
    const json* found = find(key);
    return found ? checked(*found, key, low, high) : absent;
}

int GltfObject::whole(const char* key, int low, int high, int absent) const {
    const double found = number(key, low, high, absent);
    if (found != std::floor(found))
        wrong(key, format("a whole number from {} to {}", low, high), *find(key));
    return static_cast<int>(found);
}

bool GltfObject::flag(const char* key) const {
    const json* found = find(key);
    if (found && !found->is_boolean())
        wrong(key, "true or false", *found);
    return found && found->get<bool>();
}

std::string GltfObject::text(const char* key, const std::string& absent) const {
    const json* found = find(key);
    if (found && !found->is_string())
        wrong(key, "text", *found);
    return found ? found->get<std::string>() : absent;
}

std::optional<int> GltfObject::index(const char* key, const char* array) const {
    const json* found = find(key);
    if (!found)
        return std::nullopt;
    const json& root = file_->root();
    const auto count = root.contains(array) ? static_cast<int>(root.at(array).size()) : 0;
    if (count == 0)
        wrong(key, format("an index into {}, of which there are none", array), *found);
    return whole(key, 0, count - 1, 0);
}

double GltfObject::component(const char* key, std::size_t i, std::size_t count, double low,
                             double high, double absent) const {
    const json* found = find(key);
    if (!found)
        return absent;
    if (!found->is_array() || found->size() != count)
        wrong(key, format("{} numbers", count), *found);
    return checked((*found)[i], format("{}[{}]", key, i), low, high);
}

} // namespace obscura
