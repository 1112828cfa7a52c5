#pragma once

#include "protocols/reader/study.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace obscura {

class TomlTable;

// Images that are shown boosted, so that smaller differences from a reference are seen (Men, Lin,
// Jenadeleh and Saupe 2021; ISO/IEC 29170-3): what differs is amplified, and a part of the image,
// whose magnified size is that of the whole, is shown in its place. stimuli/boost.h does it.
struct Boost {
    std::string reference = "reference"; // the role from which images differ
    double amplify = 2;                  // what their differences are multiplied by
    int magnify = 2;
    // Of each scene, the top left corner of the part, in pixels.
    std::map<std::string, std::array<int, 2>> crop;
};

// [boost]: of images of that size; scenes for which it names no corner have the middle.
Boost parseBoost(TomlTable table, int width, int height, const std::vector<View>& views);

} // namespace obscura
