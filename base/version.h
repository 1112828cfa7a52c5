#pragma once

#include <string_view>

namespace obscura {

// The program's version ("0.1.0") and the git commit it was configured at ("unknown" outside a
// checkout). Both go into every manifest and every response row.
std::string_view version();
std::string_view commit();

} // namespace obscura
