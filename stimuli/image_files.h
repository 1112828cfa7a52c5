#pragma once

#include "protocols/reader/manifest.h"
#include "renderer/render.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace obscura {

// The files of a stimulus folder, as generating writes them and verifying compares them.

constexpr const char* manifestName = "manifest.json";

// Whether the file is there with the recorded hash.
bool intact(const std::filesystem::path& folder, const FileRecord& file);

// Of an EXR of so many channels.
std::span<const std::string> channelNames(int count);

// What `layers` asks for, by kind.
std::map<std::string, const Image*> exrsOf(const Rendering& rendering);

FileRecord writtenPng(const std::filesystem::path& folder, const std::string& name,
                      const Image8& image);

// Image, visibility and, on request, EXRs, named after `file`.
ImageRecord written(const Rendering& rendering, const std::string& file,
                    const std::filesystem::path& folder, bool layers);

// That the inputs of the images that are there were equal before occlusion; else an Error at
// `place`.
void checkMatched(const ConditionRecord& condition, const Place& place);

} // namespace obscura
