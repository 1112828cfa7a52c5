#include "protocols/error.h"
#include "renderer/rows/aalborg.h"
#include "renderer/rows/obscurance.h"
#include "renderer/rows/horizon.h"

#include <fmt/format.h>

#include <string>

namespace obscura {

namespace {

constexpr Technique table[] = {
    {"none", "No ambient occlusion", "the control condition", depthOnly, nullptr, {}, {}},
    rows::crytek,
    rows::blizzard,
    rows::blizzardCorrected,
    rows::rayMarch,
    rows::alchemy,
    rows::alchemyFormOne,
    rows::alchemyCs562,
    rows::sao,
    rows::hbao,
    rows::hbaoDeinterleaved,
    rows::hbaoPlus,
    rows::multiScale,
};
static_assert(wellFormed(table));

} // namespace

std::span<const Technique> techniques() { return table; }

const Technique& technique(std::string_view id) {
    std::vector<std::string> ids;
    for (const Technique& row : table) {
        if (row.id == id)
            return row;
        ids.emplace_back(row.id);
    }
    throw Error(
        fmt::format("expected the id of a technique, found \"{}\"{}", id, suggestion(id, ids)));
}

} // namespace obscura
