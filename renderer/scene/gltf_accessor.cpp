#include "renderer/scene/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace obscura {

namespace {

template <typename T>
T load(const std::byte* at, int index = 0) {
    T value;
    std::memcpy(&value, at + static_cast<std::size_t>(index) * sizeof(T), sizeof(T));
    return value;
}

std::uint32_t wholeAt(const std::byte* at, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<std::uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(at);
    default:
        return load<std::uint32_t>(at);
    }
}

} // namespace

GltfAccessor::GltfAccessor(const GltfFile& file, const tinygltf::Model& model, int index) {
    const auto& accessor = model.accessors[static_cast<std::size_t>(index)];
    count_ = accessor.count;
    type_ = accessor.componentType;
    components_ = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    normalised_ = accessor.normalized;
    const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type_));
    const auto size = static_cast<std::size_t>(bytes) * static_cast<std::size_t>(components_);
    const auto startOf = [&](int view, std::size_t offset) {
        return file.view(static_cast<std::size_t>(view)).data() + offset;
    };
    stride_ = size;
    if (accessor.bufferView >= 0) {
        first_ = startOf(accessor.bufferView, accessor.byteOffset);
        const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
        stride_ = view.byteStride > 0 ? view.byteStride : size;
    }
    if (!accessor.sparse.isSparse)
        return;
    const auto& sparse = accessor.sparse;
    const std::byte* indices =
        startOf(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset));
    const std::byte* values =
        startOf(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset));
    const auto width = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(
        static_cast<std::uint32_t>(sparse.indices.componentType)));
    for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i)
        replaced_[wholeAt(indices + i * width, sparse.indices.componentType)] = values + i * size;
}

GltfAccessor::GltfAccessor(std::span<const float> values, int components)
    : first_(std::as_bytes(values).data()),
      count_(values.size() / static_cast<std::size_t>(components)),
      stride_(static_cast<std::size_t>(components) * sizeof(float)), components_(components),
      type_(TINYGLTF_COMPONENT_TYPE_FLOAT) {}

const std::byte* GltfAccessor::element(std::size_t index) const {
    if (!replaced_.empty())
        if (const auto found = replaced_.find(index); found != replaced_.end())
            return found->second;
    return first_ ? first_ + index * stride_ : nullptr;
}

float GltfAccessor::value(std::size_t index, int component) const {
    const std::byte* at = element(index);
    if (!at)
        return 0;
    const auto expanded = [&](float number, float most) {
        return normalised_ ? std::max(number / most, -1.0f) : number;
    };
    switch (type_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return expanded(load<std::int8_t>(at, component), 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return expanded(load<std::uint8_t>(at, component), 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return expanded(load<std::int16_t>(at, component), 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return expanded(load<std::uint16_t>(at, component), 65535);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return static_cast<float>(load<std::uint32_t>(at, component));
    default:
        return load<float>(at, component);
    }
}

std::uint32_t GltfAccessor::whole(std::size_t index) const {
    const std::byte* at = element(index);
    return at ? wholeAt(at, type_) : 0;
}

} // namespace obscura
