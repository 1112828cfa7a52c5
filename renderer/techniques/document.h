#pragma once

#include "renderer/techniques/technique.h"

#include <string>

namespace obscura {

// What people read of the technique table.

std::string_view spell(Unit unit); // "m", "degrees", "0 or 1"

// docs/techniques.md: the prose of docs/techniques.in.md, then every row of the table.
std::string techniquesDocument();

} // namespace obscura
