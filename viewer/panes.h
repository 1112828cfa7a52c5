#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace obscura {

// Where pictures that are compared lie on the screen, as functions of values. Screen coordinates
// count pixels from the window's top left corner; shares of a picture are 0 to 1 from its top left.

// How pictures of one view are put beside each other. `split` shows the first left of a divider and
// the second right of it, in one place; `flicker` shows one of two; `difference` how they differ.
enum class Layout { single, split, sideBySide, grid, flicker, difference };

const std::array<std::string, 6>& layoutNames(); // "single", "split", "side-by-side", ...
int panesOf(Layout layout);                      // 1, 2 or 4: how many are drawn

struct Box {
    double x = 0, y = 0, width = 0, height = 0;

    double right() const { return x + width; }
    double bottom() const { return y + height; }
    bool contains(double px, double py) const {
        return px >= x && px < right() && py >= y && py < bottom();
    }
};

// What part of a picture is shown: all of it at factor 1, around a centre in shares of the picture.
struct Magnification {
    double factor = 1;
    double x = 0.5, y = 0.5;
};

// A picture on the screen. `place` is where all of what the magnification shows would lie, `clip`
// the part of it that is seen. `pane` -1 is the difference.
struct PlacedPane {
    int pane = 0;
    Box place, clip;
};

// `divider` is the share of the width left of it; `flipped` shows the second in a flicker. Gaps of
// `gap` pixels lie between pictures.
std::vector<PlacedPane> placedPanes(Layout layout, const Box& area, double gap, double divider,
                                    bool flipped);

// Pixels of each picture, rendered at a scale of those of the screen; at least 16 x 16.
std::pair<int, int> pictureSize(Layout layout, const Box& area, double gap, double renderScale);

// The part of the picture that is shown, in shares.
Box shownPart(const Magnification& magnification);

// Larger by a factor, the point at the share (x, y) of the place staying where it is; between 1 and
// 64 times.
Magnification magnified(const Magnification& magnification, double by, double x, double y);

// Moved as if the picture was dragged by these shares of its place.
Magnification shifted(const Magnification& magnification, double x, double y);

// The pixel of a width x height picture that is seen at a place of the screen, from the top left.
struct PixelAt {
    int pane = 0;
    int x = 0, y = 0;
};
std::optional<PixelAt> pixelAt(const std::vector<PlacedPane>& panes,
                               const Magnification& magnification, int width, int height,
                               double screenX, double screenY);

} // namespace obscura
