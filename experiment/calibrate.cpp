#include "experiment/calibrate.h"

#include "base/csv.h"
#include "experiment/easel.h"
#include "experiment/gamma.h"
#include "experiment/page.h"
#include "experiment/screen_file.h"
#include "experiment/text.h"
#include "image/canvas.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace obscura {

namespace {

using Key = gl::Key;
using nlohmann::ordered_json;

constexpr int surround = 128;
constexpr double brightest = 1e5; // cd/m2 that a screen may have

struct Channel {
    const char* name;
    std::array<bool, 3> lit; // red, green, blue
};
constexpr Channel channels[] = {{"grey", {true, true, true}},
                                {"red", {true, false, false}},
                                {"green", {false, true, false}},
                                {"blue", {false, false, true}}};

bool pressed(const gl::Input& input, Key key) {
    return input.kind == gl::Input::Kind::press && input.key == key;
}
bool entered(const gl::Input& input) {
    return pressed(input, Key::enter) || pressed(input, Key::keypadEnter);
}

// A square patch in a field of lines, one black, one bright. Lines run across: within a line the
// signal does not change, so that no display is too slow for them.
Image8 lines(int width, int height, const Channel& channel, int code) {
    Image8 image{width, height, 3, {}};
    const int side = height / 3, left = (width - side) / 2, top = (height - side) / 2;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool patch = x >= left && x < left + side && y >= top && y < top + side;
            const int value = patch ? code : y % 2 * 255;
            for (const bool lit : channel.lit)
                image.pixels.push_back(static_cast<std::uint8_t>(lit ? value : 0));
        }
    return image;
}

Page matchPage(const Channel& channel, int code, int width, int height) {
    Page page;
    page.pictures = {1, width, height, {}};
    page.text = "Step back until the lines cannot be told apart, and make the square as bright as "
                "they are: Left and Right by one, Up and Down by eight.";
    page.note = fmt::format("{}: code {}, gamma {:.2f}", channel.name, code, gammaOfMatch(code));
    page.options = {{"Enter", "Next"}, {"Escape", "Leave"}};
    return page;
}

// A page with a drawing in its upper half.
void showBelow(Easel& easel, const Page& page, Image8 drawing, const std::string& title) {
    const DrawnPage drawn = drawPage(page, easel.width(), easel.height(), surround);
    const Box room = drawn.pictures.front();
    easel.show({{drawn.image, 0, 0}, {std::move(drawing), room.x, room.y}}, surround, title);
}

void showMatch(Easel& easel, const Channel& channel, int code) {
    const int width = easel.width() * 2 / 3, height = easel.height() / 2;
    showBelow(easel, matchPage(channel, code, width, height), lines(width, height, channel, code),
              fmt::format("match {} {}", channel.name, code));
}

int stepOf(const gl::Input& input) {
    return pressed(input, Key::left)    ? -1
           : pressed(input, Key::right) ? 1
           : pressed(input, Key::down)  ? -8
           : pressed(input, Key::up)    ? 8
                                        : 0;
}

// The code that looks as bright as the lines; nothing for Escape.
std::optional<int> matched(Easel& easel, const Channel& channel) {
    for (int code = 186;;) { // that of gamma 2.2
        showMatch(easel, channel, code);
        for (const gl::Input& input : easel.inputs()) {
            if (pressed(input, Key::escape))
                return std::nullopt;
            if (entered(input))
                return code;
            code = std::clamp(code + stepOf(input), 1, 254);
        }
    }
}

std::vector<int> patches() {
    std::vector<int> codes;
    for (int code = 0; code < 256; code += 16)
        codes.push_back(code);
    codes.push_back(255);
    return codes;
}

// As far as they are typed, by patch; a reading is a number, or nothing.
using Typed = std::map<int, std::string>;

bool isReading(const std::string& text) {
    double value = 0;
    return readCell(text, value) && value >= 0 && value <= brightest;
}

// With a narrow band of words at its foot, so that the rest is as even as can be.
void showPatch(Easel& easel, int code, const std::string& typed) {
    const int type = easel.height() / 36, band = 2 * type;
    Canvas words(easel.width(), band, surround / 255.0);
    words.text(type, type / 3,
               fmt::format("Code <b>{}</b>: <b>{}│</b> cd/m²    Enter: next    Left, Right: other "
                           "patches    Escape: leave",
                           code, typed),
               type);
    easel.show({{words.finish(), 0, easel.height() - band}}, code,
               fmt::format("patch {} {}", code, typed));
}

void type(std::string& typed, const gl::Input& input) {
    const char letter = static_cast<char>(input.symbol);
    const bool number = (letter >= '0' && letter <= '9') || letter == '.';
    if (input.kind == gl::Input::Kind::text && input.symbol < 128 && number && typed.size() < 12)
        typed += letter;
    if (pressed(input, Key::backspace) && !typed.empty())
        typed.pop_back();
}

// Readings of the patches, some of them left out; nothing for Escape.
std::optional<Typed> readPatches(Easel& easel) {
    const std::vector<int> codes = patches();
    Typed typed;
    for (std::size_t at = 0; at < codes.size();) {
        std::string& reading = typed[codes[at]];
        showPatch(easel, codes[at], reading);
        for (const gl::Input& input : easel.inputs()) {
            const bool whole = reading.empty() || isReading(reading);
            if (pressed(input, Key::escape))
                return std::nullopt;
            type(reading, input);
            const bool back = pressed(input, Key::left) && at > 0;
            if (whole && (back || entered(input) || pressed(input, Key::right))) {
                at = back ? at - 1 : at + 1;
                break; // what else was pressed meanwhile was for the patch before
            }
        }
    }
    return typed;
}

std::vector<LuminanceReading> readingsOf(const Typed& typed) {
    std::vector<LuminanceReading> readings;
    for (const auto& [code, text] : typed)
        if (double value = 0; readCell(text, value))
            readings.push_back({code, value});
    return readings;
}

std::string inWords(const std::optional<GammaFit>& fit) {
    return fit ? fmt::format("gamma {:.3f}, white {:.4g} cd/m², black {:.4g} cd/m²", fit->gamma,
                             fit->at(255), fit->black)
               : "too few readings for a curve";
}

bool confirmed(Easel& easel, const std::vector<LuminanceReading>& readings,
               const std::optional<GammaFit>& fit) {
    const int width = easel.width() * 3 / 4, height = easel.height() * 3 / 5;
    Page page;
    page.pictures = {1, width, height, {}};
    page.heading = inWords(fit);
    page.options = {{"Enter", "Keep"}, {"Escape", "Leave"}};
    showBelow(easel, page, drawGamma(readings, fit, width, height, surround), "the curve");
    for (;;)
        for (const gl::Input& input : easel.inputs()) {
            if (entered(input))
                return true;
            if (pressed(input, Key::escape))
                return false;
        }
}

ordered_json spell(const std::vector<LuminanceReading>& readings,
                   const std::optional<GammaFit>& fit) {
    ordered_json json = {{"readings", ordered_json::array()}};
    for (const auto& [code, luminance] : readings)
        json["readings"].push_back({{"code", code}, {"cd_m2", luminance}});
    if (fit)
        json.update(
            {{"gamma", fit->gamma}, {"scale_cd_m2", fit->scale}, {"black_cd_m2", fit->black}});
    return json;
}

} // namespace

bool calibrate(const gl::WindowOptions& window, const std::filesystem::path& data) {
    Easel easel(window);
    ordered_json byEye;
    for (const Channel& channel : channels) {
        const std::optional<int> code = matched(easel, channel);
        if (!code)
            return false;
        byEye[channel.name] = {{"code", *code}, {"gamma", gammaOfMatch(*code)}};
    }
    const std::optional<Typed> typed = readPatches(easel);
    if (!typed)
        return false;
    const std::vector<LuminanceReading> readings = readingsOf(*typed);
    const std::optional<GammaFit> fit = fitGamma(readings);
    if (!confirmed(easel, readings, fit))
        return false;
    const std::filesystem::path file = screenFile(data, easel.monitor());
    keepMeasured(file, easel.monitor(), "gamma_by_eye", byEye);
    if (!readings.empty())
        keepMeasured(file, easel.monitor(), "luminance", spell(readings, fit));
    fmt::print("by eye: gamma {:.2f}; {} readings: {}; kept in {}\n",
               byEye["grey"]["gamma"].get<double>(), readings.size(), inWords(fit), file.string());
    return true;
}

} // namespace obscura
