#include "protocols/reader/screen.h"

#include "base/error.h"
#include "protocols/reader/toml_table.h"

#include <fmt/format.h>

namespace obscura {

ScreenNeeds parseScreenNeeds(TomlTable table) {
    ScreenNeeds needs;
    needs.distanceCm = table.number("distanceCm", 10, 2000);
    if (const auto degrees = table.numbers("degrees", 0.1, 170); !degrees.empty()) {
        if (degrees.size() != 2)
            throw Error(table.placeOf("degrees"),
                        fmt::format("expected an image's width and height in degrees, found {} "
                                    "numbers",
                                    degrees.size()));
        needs.degrees = {degrees[0], degrees[1]};
    }
    if (auto range = table.table("pixelsPerDegree")) {
        const double least = range->number("min", 0, 10000, 0),
                     most = range->number("max", 0, 10000, 10000);
        if (least > most)
            throw Error(range->placeOf("max"),
                        fmt::format("expected no less than \"min\", {}, found {}", least, most));
        range->finish();
        needs.pixelsPerDegree = {least, most};
    }
    table.finish();
    return needs;
}

} // namespace obscura
