#pragma once

#include "renderer/scene/scene.h"

// The makers of the scenes that builtin.h offers; their sha256 is left empty.
namespace obscura::builtin {

Scene sculpture();
Scene atrium();
Scene figures();

} // namespace obscura::builtin
