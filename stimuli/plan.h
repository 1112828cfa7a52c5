#pragma once

#include "protocols/reader/protocol.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// One image to make. Pure: nothing here needs files or OpenGL.
struct PlannedImage {
    std::size_t condition = 0; // index into the protocol's conditions
    int member = 0;            // index into the condition's roles
    std::string file;          // name of its PNG; layers go beside it
};

// Every image of every condition, in the order that loads each scene and sets up each lighting
// once.
std::vector<PlannedImage> plan(const Protocol& protocol);

} // namespace obscura
