#include "protocols/reader/boost.h"

#include "protocols/reader/study_parts.h"

#include <fmt/format.h>

namespace obscura {

namespace {

std::array<int, 2> parseCorner(TomlTable& crop, const std::string& scene, int right, int bottom) {
    const std::vector<double> corner = crop.numbers(scene, 0, 8192);
    const bool whole = corner.size() == 2 && corner[0] == static_cast<int>(corner[0]) &&
                       corner[1] == static_cast<int>(corner[1]) && corner[0] <= right &&
                       corner[1] <= bottom;
    if (!whole)
        throw Error(crop.placeOf(scene),
                    fmt::format("expected the top left corner of the part that is magnified, [x, "
                                "y] in whole pixels, at most [{}, {}], found {}",
                                right, bottom, TomlTable::spell(*crop.node(scene))));
    return {static_cast<int>(corner[0]), static_cast<int>(corner[1])};
}

} // namespace

Boost parseBoost(TomlTable table, int width, int height, const std::vector<View>& views) {
    Boost boost;
    boost.reference = table.text("reference", boost.reference);
    boost.amplify = table.number("amplify", 1, 16, boost.amplify);
    boost.magnify = table.integer("magnify", 1, 8, boost.magnify);
    if (width % boost.magnify != 0 || height % boost.magnify != 0)
        throw Error(table.placeOf("magnify"),
                    fmt::format("expected a divisor of the images' width and height, {} and {}, "
                                "found {}",
                                width, height, boost.magnify));
    const int right = width - width / boost.magnify, bottom = height - height / boost.magnify;
    for (const View& view : views)
        boost.crop[view.name] = {right / 2, bottom / 2};
    if (auto crop = table.table("crop")) {
        for (const View& view : views)
            if (crop->has(view.name))
                boost.crop[view.name] = parseCorner(*crop, view.name, right, bottom);
        crop->finish();
    }
    table.finish();
    return boost;
}

} // namespace obscura
