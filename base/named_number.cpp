#include "base/named_number.h"

#include "base/csv.h"

#include <cmath>

namespace obscura {

std::optional<NamedNumber> readNamedNumber(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals == 0)
        return {};
    NamedNumber result{std::string(text.substr(0, equals)), 0};
    if (!readCell(text.substr(equals + 1), result.value) || !std::isfinite(result.value))
        return {};
    return result;
}

} // namespace obscura
