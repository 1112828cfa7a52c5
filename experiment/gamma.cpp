#include "experiment/gamma.h"

#include "image/canvas.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

double GammaFit::at(int code) const { return black + scale * std::pow(code / 255.0, gamma); }

std::optional<GammaFit> fitGamma(const std::vector<LuminanceReading>& readings) {
    GammaFit fit;
    for (const LuminanceReading& reading : readings)
        if (reading.code == 0)
            fit.black = reading.luminance;
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [code, luminance] : readings) {
        if (code <= 0 || luminance <= fit.black)
            continue;
        const double u = std::log(code / 255.0), v = std::log(luminance - fit.black);
        const double w = (luminance - fit.black) * (luminance - fit.black);
        n += w, x += w * u, y += w * v, xx += w * u * u, xy += w * u * v;
    }
    const double spread = n * xx - x * x;
    if (spread <= 1e-9 * n * n) // all of one code
        return std::nullopt;
    fit.gamma = (n * xy - x * y) / spread;
    fit.scale = std::exp((y - fit.gamma * x) / n);
    return fit.gamma > 0 ? std::optional(fit) : std::nullopt;
}

double gammaOfMatch(int code) { return std::log(0.5) / std::log(code / 255.0); }

Image8 drawGamma(const std::vector<LuminanceReading>& readings, const std::optional<GammaFit>& fit,
                 int width, int height, int grey) {
    constexpr int around = 60, type = 16;
    Canvas canvas(width, height, grey / 255.0);
    cairo_t* cairo = canvas.cairo();
    double most = fit ? fit->at(255) : 0;
    for (const LuminanceReading& reading : readings)
        most = std::max(most, reading.luminance);
    most = std::max(most, 1e-6);
    const auto across = [&](double code) { return around + code / 255 * (width - 2 * around); };
    const auto up = [&](double luminance) {
        return height - around - luminance / most * (height - 2 * around);
    };
    cairo_set_source_rgb(cairo, 0, 0, 0);
    cairo_set_line_width(cairo, 2);
    cairo_move_to(cairo, across(0), up(most));
    cairo_line_to(cairo, across(0), up(0));
    cairo_line_to(cairo, across(255), up(0));
    cairo_stroke(cairo);
    for (int code = 0; fit && code <= 255; ++code)
        cairo_line_to(cairo, across(code), up(fit->at(code)));
    cairo_stroke(cairo);
    for (const auto& [code, luminance] :
         readings) { // rings, seen where the curve goes through them
        cairo_arc(cairo, across(code), up(luminance), 6, 0, 2 * 3.14159265358979);
        cairo_stroke(cairo);
    }
    canvas.text(around, height - around + 12, "0", type);
    canvas.text(width - around - 12, height - around + 12, "255", type);
    canvas.text(8, around - 30, fmt::format("{:.4g} cd/m²", most), type);
    return canvas.finish();
}

} // namespace obscura
