#pragma once

#include "renderer/scene/scene.h"

// The makers of the scenes that builtin.h offers; they leave its sha256 empty, which builtinScene()
// fills in.
namespace obscura::builtin {

Scene sculpture();
Scene atrium();
Scene figures();
Scene room();
Scene garden();

} // namespace obscura::builtin
