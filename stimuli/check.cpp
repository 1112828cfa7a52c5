#include "stimuli/generate.h"
#include "stimuli/plan.h"
#include "stimuli/warnings.h"

namespace obscura {

std::vector<std::string> check(const Protocol& protocol, const Folders& folders,
                               const gl::Driver& driver, const Announce& announce) {
    SceneHashes scenes(folders);
    RecipeRenderer renderer(folders);
    Warnings warnings(protocol, renderer);
    std::vector<std::string> found;
    std::vector<std::vector<Recipe>> recipes(protocol.conditions.size());
    const std::vector<PlannedImage> images = plan(protocol);
    for (std::size_t i = 0; i < images.size(); ++i) {
        announce(static_cast<int>(i), static_cast<int>(images.size()), images[i].file);
        const Condition& condition = protocol.conditions[images[i].condition];
        std::vector<Recipe>& own = recipes[images[i].condition];
        own.push_back(makeRecipe(protocol, condition, images[i].member, scenes, driver));
        if (own.size() < condition.roles.size())
            continue;
        addOnce(found, warnings.of(condition, own));
        addOnce(found, ofScene(condition.view, renderer.sceneWarnings()));
    }
    return found;
}

} // namespace obscura
