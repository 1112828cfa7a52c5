#pragma once

#include "experiment/viewing.h"
#include "gl/window.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace obscura {

// What was measured of a screen, in <data>/screens/<machine>_<monitor>.json: with the data, because
// they need it and are copied with it, and a file for each machine and monitor, because a folder
// may serve several. A measurement holds for the mode in which it was made.
std::filesystem::path screenFile(const std::filesystem::path& data, const gl::Monitor& monitor);

// Adds what was measured under that key, or puts it in the place of an earlier one.
void keepMeasured(const std::filesystem::path& file, const gl::Monitor& monitor,
                  const std::string& key, const nlohmann::ordered_json& measured);

// What stands under that key; null where nothing does, or only for another mode. An Error names the
// file when it is none of this program's.
nlohmann::ordered_json measured(const std::filesystem::path& file, const gl::Monitor& monitor,
                                const std::string& key);

// What was kept of its curve, by eye and by photometer; an empty object for nothing.
nlohmann::ordered_json calibrationOf(const std::filesystem::path& data, const gl::Monitor& monitor);

// By the card that somebody held to it.
std::optional<ScreenSize> cardSize(const std::filesystem::path& data, const gl::Monitor& monitor);

} // namespace obscura
