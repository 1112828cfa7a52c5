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
    rows::aalborg::crytek,
    rows::aalborg::blizzard,
    rows::aalborg::blizzardCorrected,
    rows::aalborg::rayMarch,
    rows::obscurance::alchemy,
    rows::obscurance::alchemyFormOne,
    rows::obscurance::alchemyCs562,
    rows::obscurance::sao,
    rows::horizon::hbao,
    rows::horizon::hbaoDeinterleaved,
    rows::horizon::hbaoPlus,
    rows::horizon::multiScale,
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
