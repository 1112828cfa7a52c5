#pragma once

#include "renderer/scene/quads.h"
#include "viewer/picture.h"

namespace obscura {

// A box on a floor before a wall: a scene that takes no time to make, and where a view of it is.
inline Scene room() {
    Scene scene;
    addQuad(scene,
            {glm::vec3(-4, 0, 4), glm::vec3(4, 0, 4), glm::vec3(4, 0, -2), glm::vec3(-4, 0, -2)});
    addQuad(scene,
            {glm::vec3(-4, 0, -2), glm::vec3(4, 0, -2), glm::vec3(4, 4, -2), glm::vec3(-4, 4, -2)});
    addBox(scene, {-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f});
    return scene;
}

inline Settings settingsOf(const char* id, const std::map<std::string, double>& values = {}) {
    Settings settings{technique(id)};
    for (const auto& [name, value] : values)
        settings.set(name, value);
    return settings;
}

// Of the scene with that id, under light from everywhere and the sun.
inline Wanted wantedOf(SceneId scene, std::vector<Settings> panes) {
    Wanted wanted;
    wanted.scene = scene;
    wanted.view.camera.position = {1, 1.5, 4};
    wanted.view.camera.target = {0, 0.5, 0};
    wanted.view.radius = 0.5;
    wanted.level.ambient = Vec3{0.6, 0.6, 0.6};
    wanted.level.sun = Sun{};
    wanted.width = 160;
    wanted.height = 90;
    wanted.panes = std::move(panes);
    return wanted;
}

} // namespace obscura
