// The tab of what is looked at: scene, camera, light, and how the picture is made.
#include "renderer/levels.h"
#include "viewer/navigation.h"
#include "viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

std::string grouped(std::size_t number) {
    std::string text = std::to_string(number);
    for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3)
        text.insert(static_cast<std::size_t>(at), " ");
    return text;
}

void sceneFacts(Moment& moment) {
    Ui& ui = moment.ui;
    heading(ui, "Scene");
    const float gap = ui.px(6);
    const float half = (ImGui::GetContentRegionAvail().x - gap) / 2;
    if (button(ui, "Open…", "A glTF file (.gltf, .glb)  (Ctrl+O)", half))
        moment.requests.browse = true;
    ImGui::SameLine(0, gap);
    if (button(ui, "Frame scene", "The view that the scene opened with  (F)", half))
        moment.requests.frame = true;
    if (!moment.opened)
        return;
    const Opened& opened = *moment.opened;
    fact(ui, "Name", nameOf(opened.choice), opened.choice.file);
    fact(ui, "Triangles", grouped(opened.triangles));
    const glm::vec3 e = opened.bounds.high - opened.bounds.low;
    fact(ui, "Size", fmt::format("{:.3g} × {:.3g} × {:.3g} m", e.x, e.y, e.z));
    if (!opened.warnings.empty()) {
        std::string all = "What the file has and the picture lacks";
        for (const std::string& warning : opened.warnings)
            all += "\n" + warning;
        fact(ui, "Warnings", std::to_string(opened.warnings.size()), all);
    }
}

void cameraRows(Moment& moment) {
    Ui& ui = moment.ui;
    State& state = moment.state;
    heading(ui, "Camera");
    std::vector<std::string> names;
    for (const View& view : state.views)
        names.push_back(view.name);
    int chosen = state.viewAt;
    if (!names.empty() && choice(ui, "View  (C)##views", names, chosen))
        showView(state, chosen);
    Camera& camera = state.view.camera;
    double fov = camera.fovDegrees;
    if (slider(ui,
               {"Field of view", scaleBetween(1, 120),
                moment.opened ? moment.opened->camera.fovDegrees : 50, Unit::degree,
                "Vertical\nAlt and the wheel change it too"},
               fov))
        camera.fovDegrees = fov;
    const double standard = moment.opened ? moment.opened->camera.near : camera.near;
    double near = camera.near > 0 ? camera.near : standard;
    if (near > 0 && slider(ui,
                           {"Near plane", scaleBetween(state.size * 1e-5, state.size / 10),
                            standard, Unit::metre, "Nothing nearer to the camera is seen"},
                           near))
        camera.near = near;
    slider(ui,
           {"Speed (m/s)", scaleBetween(state.size / 1000, state.size), walkingSpeed(state.size),
            Unit::ratio,
            "Of flying\nThe wheel changes it while the right button is held or the "
            "cursor is locked; Shift hurries"},
           state.speed);
    const auto text = [](const Vec3& v) {
        const auto plain = [](double x) { return std::round(x * 1000) / 1000 + 0.0; }; // no "-0"
        return fmt::format("{:.3f}  {:.3f}  {:.3f}", plain(v[0]), plain(v[1]), plain(v[2]));
    };
    fact(ui, "Position", text(camera.position));
    fact(ui, "Target", text(camera.target));
    const float gap = ui.px(6);
    const float third = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
    if (button(ui, "Store", "Keeps the present view in the list, for good  (P)", third))
        moment.requests.storeView = true;
    ImGui::SameLine(0, gap);
    const std::size_t own = moment.opened ? moment.opened->cameras.size() + 1 : 0;
    ImGui::BeginDisabled(static_cast<std::size_t>(state.viewAt) < own || names.empty());
    if (button(ui, "Forget", "Takes the chosen view out of the list, if it was stored", third))
        moment.requests.forgetView = true;
    ImGui::EndDisabled();
    ImGui::SameLine(0, gap);
    const Vec3 &p = camera.position, &t = camera.target;
    if (button(ui, "Copy", "The camera, as obscura-render's --camera takes it", third))
        moment.requests.copy = fmt::format("--camera {:.5g} {:.5g} {:.5g} {:.5g} {:.5g} {:.5g} "
                                           "--fov {:.4g}",
                                           p[0], p[1], p[2], t[0], t[1], t[2], camera.fovDegrees);
}

void sunRows(Ui& ui, Sun& sun) {
    slider(ui, {"Sun's azimuth", scaleBetween(-180, 180), 62, Unit::degree, "From +z towards +x"},
           sun.azimuthDegrees);
    slider(ui, {"Sun's elevation", scaleBetween(0, 90), 66, Unit::degree, "Above the horizon"},
           sun.elevationDegrees);
}

void lightRows(Moment& moment) {
    Ui& ui = moment.ui;
    State& state = moment.state;
    heading(ui, "Light");
    static const std::vector<std::string> levels{"Low", "Moderate", "High"};
    const auto names = levelNames();
    int level =
        static_cast<int>(std::find(names.begin(), names.end(), state.level.name) - names.begin());
    if (segments(ui, "##level", levels, level)) {
        const Curve curve = state.level.curve;
        const bool lamps = state.level.sceneLights;
        state.level = levelNamed(names[static_cast<std::size_t>(level)]);
        state.level.sceneLights = lamps;
        if (state.level.name != "low")
            state.level.curve = curve;
    }
    if (state.level.sun)
        sunRows(ui, *state.level.sun);
    toggle(ui, "The file's lights", state.level.sceneLights,
           "Lamps that the scene's file brings, without shadows");
    slider(ui,
           {"Exposure", scaleBetween(-8, 8), 0, Unit::ratio,
            "In stops: light is scaled by 2 to this power before the display curve"},
           state.view.exposure);
    if (button(ui, "Meter", "Sets the exposure by the picture that is shown lit, as a camera does",
               ImGui::GetContentRegionAvail().x))
        moment.requests.meter = true;
    static const std::vector<std::string> curves = [] {
        std::vector<std::string> words;
        for (const std::string& name : curveNames())
            words.push_back(inWords(std::string_view(name)));
        return words;
    }();
    int curve = static_cast<int>(state.level.curve);
    if (choice(ui, "Tone curve", curves, curve))
        state.level.curve = static_cast<Curve>(curve);
}

void pictureRows(Moment& moment) {
    Ui& ui = moment.ui;
    State& state = moment.state;
    heading(ui, "Picture");
    toggle(ui, "Textures", state.textures,
           "Off: everything is white and matte, so that only shape is seen  (T)");
    static const std::vector<std::string> kinds{"Face", "Smooth", "Mapped"};
    int kind = static_cast<int>(state.normals);
    if (segments(ui, "Normals", kinds, kind,
                 "Which normals occlusion works with\nThe triangle's own, interpolated, or with "
                 "the normal map"))
        state.normals = static_cast<Normals>(kind);
    slider(ui,
           {"Render scale", scaleBetween(0.1, 1), 1, Unit::ratio,
            "Pixels that are drawn for each of the screen's, across and down\nLess is faster"},
           state.renderScale);
}

} // namespace

void viewTab(Moment& moment) {
    sceneFacts(moment);
    cameraRows(moment);
    lightRows(moment);
    pictureRows(moment);
}

} // namespace obscura
