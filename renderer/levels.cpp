#include "renderer/levels.h"

#include <algorithm>
#include <array>

namespace obscura {

std::span<const std::string> levelNames() {
    static const std::array<std::string, 3> names{"low", "moderate", "high"};
    return names;
}

Level levelNamed(const std::string& name) {
    const auto names = levelNames();
    if (std::find(names.begin(), names.end(), name) == names.end())
        throw Error("there is no level of light \"" + name + "\"" + suggestion(name, names));
    Level level;
    level.name = name;
    if (name == "low") {
        level.ambient = Vec3{1, 1, 1};
        level.curve = Curve::clamp;
        return level;
    }
    level.sky = Sky{};
    if (name == "high")
        level.sun = Sun{62, 66, {4, 3.8, 3.4}};
    return level;
}

} // namespace obscura
