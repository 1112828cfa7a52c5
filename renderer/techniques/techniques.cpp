#include "base/error.h"
#include "renderer/techniques/rows/aalborg.h"
#include "renderer/techniques/rows/gtao.h"
#include "renderer/techniques/rows/horizon.h"
#include "renderer/techniques/rows/light.h"
#include "renderer/techniques/rows/objects.h"
#include "renderer/techniques/rows/obscurance.h"
#include "renderer/techniques/rows/points.h"
#include "renderer/techniques/rows/traced.h"
#include "renderer/techniques/rows/vao_plus_plus.h"
#include "renderer/techniques/rows/volume.h"

#include <fmt/format.h>

#include <string>

namespace obscura {

namespace {

constexpr Technique table[] = {
    {"none", "No ambient occlusion", "the control condition", depthOnly, nullptr, {}, {}},
    rows::aalborg::crytek,
    rows::points::crytekShaderX7,
    rows::aalborg::blizzard,
    rows::aalborg::blizzardCorrected,
    rows::points::starcraft,
    rows::aalborg::rayMarch,
    rows::horizon::hbao,
    rows::horizon::hbaoDeinterleaved,
    rows::horizon::hbaoPlus,
    rows::horizon::multiScale,
    rows::gtao::gtao,
    rows::gtao::visibilityBitmask,
    rows::gtao::gtVbao,
    rows::obscurance::alchemy,
    rows::obscurance::alchemyFormOne,
    rows::obscurance::alchemyCs562,
    rows::obscurance::sao,
    rows::volume::obscurance,
    rows::volume::obscurancePoints,
    rows::volume::obscuranceArea,
    rows::volume::vao,
    rows::vao::vaoPlusPlus,
    rows::lit::ssdo,
    rows::lit::proxySpheresTechnique,
    rows::objects::volumes,
    rows::objects::voxelAo,
    rows::traced::rayTraced,
    rows::traced::rtao,
    rows::traced::rtaoBvh,
};
static_assert(wellFormed(table));

} // namespace

const std::array<std::string, 4>& workNames() {
    static const std::array<std::string, 4> names{"prepare", "gather", "filter", "upsample"};
    return names;
}

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
