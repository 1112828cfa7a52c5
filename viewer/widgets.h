#pragma once

#include "renderer/techniques/technique.h"
#include "viewer/panes.h"
#include "viewer/slider.h"
#include "viewer/style.h"

#include <initializer_list>
#include <limits>
#include <map>
#include <span>
#include <string>

namespace obscura {

// What panels are made of. A widget is a function that draws it and says what the user did to it;
// labels tell widgets of one panel apart, and what follows "##" in them is not shown.

// What all of one frame's widgets share.
struct Ui {
    const Theme& theme;
    std::map<std::string, Box> places; // of each widget drawn in this frame, by its label
    double wakeIn = std::numeric_limits<double>::infinity(); // seconds until the next frame that
                                                             // widgets need, whatever happens

    float px(double logical) const { return static_cast<float>(logical) * theme.scale; }
    void note(const char* label); // the last item's place
    void wake(double seconds);
};

// What rows have in common, logical pixels: the sign that resets stands at the end of the label.
constexpr double rowLabelWidth = 152, rowResetWidth = 18, rowValueWidth = 58, rowHeight = 24;
void rowLabel(Ui& ui, const std::string& name, ImU32 colour);
// Where the text begins that is in the middle between two corners.
ImVec2 centredText(const ImVec2& low, const ImVec2& high, const char* text);

// A part of the text up to "##".
std::string shown(const char* label);

// A heading with space above.
void heading(Ui& ui, const char* text);
// Wrapped small grey text.
void remark(Ui& ui, const std::string& text, ImU32 colour = colours::muted);
// A name on the left and what it is on the right. What does not fit is cut on the left, and whole
// in its tooltip.
void fact(Ui& ui, const char* name, const std::string& value, const std::string& tip = {});
// Shown while the item before is hovered, after a moment.
void tooltip(Ui& ui, const std::string& text);
// The text, or its beginning with "…", that is no wider.
std::string fitted(const std::string& text, float width, bool keepEnd = false);

// A slider in one row: name, track, value, and a sign that sets the standard value again. Click or
// drag to set; with Shift, finely; double-click to type.
struct SliderRow {
    const char* label;
    Scale scale;
    double standard; // value
    Unit unit = Unit::ratio;
    std::string tip;
};
bool slider(Ui& ui, const SliderRow& row, double& value);

// A name and a switch.
bool toggle(Ui& ui, const char* label, bool& on, const std::string& tip = {});

// A name and one of several words, all seen.
bool segments(Ui& ui, const char* label, std::span<const std::string> words, int& chosen,
              const std::string& tip = {});

// A name and one of many words, in a list that opens. `tips` has one for each word, or none.
bool choice(Ui& ui, const char* label, std::span<const std::string> words, int& chosen,
            std::span<const std::string> tips = {});

// `width` 0 is that of its text; below 0 it is all there is.
enum class ButtonKind { plain, primary, quiet };
bool button(Ui& ui, const char* label, const std::string& tip = {}, float width = 0,
            ButtonKind kind = ButtonKind::plain, bool on = false);

// A bar that is filled to a share.
void progressBar(Ui& ui, double share, float width, float height);

} // namespace obscura
