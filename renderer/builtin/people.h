#pragma once

#include "renderer/builtin/figure.h"

namespace obscura::builtin {

Body reader(); // veiled, in a long gown and a mantle, an open book in both hands
Body guard();  // cloaked, in a tunic and boots, both hands on the hilt of a sword

} // namespace obscura::builtin
