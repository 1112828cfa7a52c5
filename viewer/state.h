#pragma once

#include "viewer/panes.h"
#include "viewer/picture.h"

#include <string>
#include <vector>

namespace obscura {

struct Opened;

enum class Tab { techniques, view, measure, study };
const std::vector<std::string>& tabTitles(); // "Techniques", ...

// What a person has set in the window: plain values. Panels show and change them; what is to be
// drawn follows from them.
struct State {
    State(); // four panes: none, gtao, hbao, starcraft

    SceneChoice scene; // shown, or being opened
    SceneId sceneId = 0;
    View view; // camera, radius, exposure
    Level level;
    Normals normals = Normals::smooth;
    bool textures = true;
    double renderScale = 1;

    std::vector<Settings> panes; // always four; the layout says how many are seen
    int selected = 1;            // the pane whose settings are shown, and which is seen alone
    bool sameSamples = false;    // all panes make as many fetches as the first

    Show show = Show::lit;
    bool reference = false;
    double errorScale = 0.25;
    Integral integral = Integral::cosine;
    int display = 0; // of displays()

    Layout layout = Layout::split;
    double divider = 0.5; // share of the width
    bool flipped = false; // a flicker shows the second
    Magnification magnification;

    std::vector<View> views; // the scene's cameras and what was stored, by name
    int viewAt = 0;          // the one chosen last
    double speed = 1;        // of flying, metres per second
    double size = 1;         // diagonal of the scene, metres

    bool panels = true, help = false;
    Tab tab = Tab::techniques;
};

// Which of the panes is seen in a place of the layout: the selected one where only one is seen.
int paneAt(const State& state, int place);

// What is to be drawn in panes of such a place.
Wanted wantedOf(const State& state, const Box& area, double gap);

// Takes the view, cameras and size of a scene that was opened, and the views stored of it.
void adopt(State& state, const Opened& opened, const std::vector<View>& stored = {});

// The technique of a pane with its defaults, and the view's radius.
void setTechnique(State& state, int pane, const Technique& technique);
void setRadius(State& state, double metres);

// The next view of the list (or, with -1, the one before), or that one.
void cycleViews(State& state, int step);
void showView(State& state, int index);
// Adds the present view to the list. Gives its name.
std::string storeView(State& state);

// The settings with as many texture fetches a pixel as can be had next to `fetches`, by the counts
// that say how many samples are taken (samples; directions or slices, and steps), whose ratio is
// kept as far as it goes. Techniques without such counts stay as they are.
Settings withFetches(const Settings& settings, double fetches);
void matchSamples(State& state); // where the state wants it

} // namespace obscura
