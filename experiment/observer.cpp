#include "experiment/observer.h"

#include <fmt/format.h>

namespace obscura {

const std::string& Upcoming::role(const std::string& image) const {
    for (std::size_t i = 0; i < order.size(); ++i)
        if (image == fmt::format("{}", i + 1))
            return order[i];
    return image;
}

} // namespace obscura
