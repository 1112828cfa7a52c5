#include "experiment/viewing.h"

#include "base/arguments.h"
#include "base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

constexpr double angleTolerance = 0.05; // of an angle that a study wants
constexpr double square = 0.03;
constexpr double degree = 3.14159265358979323846 / 180;

double distanceInPixels(const Viewing& viewing) {
    return viewing.needs.distanceCm * 10 * viewing.size->pixelsPerMm;
}

double centimetres(const Viewing& viewing, double pixels) {
    return pixels / viewing.size->pixelsPerMm / 10;
}

std::string objectionToDegrees(const Viewing& viewing, int pixels, double wanted,
                               const char* across) {
    const double found = viewing.degrees(pixels);
    if (std::abs(found - wanted) <= angleTolerance * wanted)
        return {};
    const double distance = centimetres(viewing, pixels / 2.0 / std::tan(wanted * degree / 2));
    return fmt::format("expected images {:.4g} degrees {}, found {:.4g} at {:.4g} cm; at {:.4g} cm "
                       "they would be",
                       wanted, across, found, viewing.needs.distanceCm, distance);
}

std::string objectionToPixels(const Viewing& viewing) {
    const double found = viewing.pixelsPerDegree();
    const auto& [least, most] = *viewing.needs.pixelsPerDegree;
    if (found >= least && found <= most)
        return {};
    const double distance = viewing.needs.distanceCm * (found < least ? least : most) / found;
    return fmt::format("expected {:.4g} to {:.4g} pixels per degree, found {:.4g} at {:.4g} cm; "
                       "expected {} {:.4g} cm",
                       least, most, found, viewing.needs.distanceCm,
                       found < least ? "at least" : "at most", distance);
}

} // namespace

ScreenSize screenSizeOf(const std::string& millimetres, int width, int height) {
    const auto size = parsePair(millimetres, 'x');
    if (!size || std::min(size->first, size->second) < 20 ||
        std::max(size->first, size->second) > 20000)
        throw Error(fmt::format("--screen-mm: expected the width and height of what the screen "
                                "shows in millimetres, such as 598x336, found \"{}\"",
                                millimetres));
    const double across = width / static_cast<double>(size->first),
                 down = height / static_cast<double>(size->second);
    if (std::abs(across / down - 1) > square)
        throw Error(fmt::format("--screen-mm: expected square pixels, but {} mm with {}x{} pixels "
                                "have {:.3f} per mm across and {:.3f} down; measure again, what "
                                "shows a picture only",
                                millimetres, width, height, across, down));
    return {across, "--screen-mm"};
}

double Viewing::pixelsPerDegree() const {
    return 2 * distanceInPixels(*this) * std::tan(degree / 2);
}

double Viewing::degrees(int pixels) const {
    return 2 * std::atan(pixels / 2.0 / distanceInPixels(*this)) / degree;
}

std::string objectionTo(const Viewing& viewing) {
    if (!viewing.needs.degrees && !viewing.needs.pixelsPerDegree)
        return {};
    if (!viewing.size)
        return "the study wants images of a certain visual angle, but the size of this screen is "
               "not "
               "known; measure it with obscura-experiment card, or give --screen-mm WxH";
    if (viewing.needs.degrees) {
        const auto& [across, down] = *viewing.needs.degrees;
        if (std::string wrong = objectionToDegrees(viewing, viewing.width, across, "wide");
            !wrong.empty())
            return wrong;
        if (std::string wrong = objectionToDegrees(viewing, viewing.height, down, "high");
            !wrong.empty())
            return wrong;
    }
    return viewing.needs.pixelsPerDegree ? objectionToPixels(viewing) : "";
}

std::string inWords(const Viewing& viewing) {
    if (!viewing.size)
        return {};
    const std::string size =
        fmt::format("{:.3f} pixels per mm ({})", viewing.size->pixelsPerMm, viewing.size->source);
    if (!viewing.known())
        return size;
    return fmt::format("{:.1f} pixels per degree at {:g} cm, images {:.1f} x {:.1f} degrees; {}",
                       viewing.pixelsPerDegree(), viewing.needs.distanceCm,
                       viewing.degrees(viewing.width), viewing.degrees(viewing.height), size);
}

void describe(const Viewing& viewing, nlohmann::ordered_json& sidecar) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (viewing.needs.distanceCm > 0)
        json["distance_cm"] = viewing.needs.distanceCm;
    if (viewing.size) {
        json["pixels_per_mm"] = viewing.size->pixelsPerMm;
        json["size_source"] = viewing.size->source;
    }
    if (viewing.known()) {
        json["pixels_per_degree"] = viewing.pixelsPerDegree();
        json["image_degrees"] = {viewing.degrees(viewing.width), viewing.degrees(viewing.height)};
    }
    if (!json.empty())
        sidecar["viewing"] = std::move(json);
}

} // namespace obscura
