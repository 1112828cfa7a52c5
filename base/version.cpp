#include "base/version.h"

namespace obscura {

std::string_view version() { return OBSCURA_VERSION; }
std::string_view commit() { return OBSCURA_COMMIT; }

} // namespace obscura
