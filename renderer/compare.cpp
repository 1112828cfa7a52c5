#include "renderer/compare.h"

#include "base/error.h"
#include "image/canvas.h"
#include "metrics/color_video_vdp.h"
#include "metrics/flip.h"
#include "metrics/image_error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace obscura {

namespace {

namespace fs = std::filesystem;

struct CompareOptions {
    fs::path test, reference, maps;
    std::vector<std::string> display;
    bool json = false;
};

// As a display shows it: a file of floats is linear light.
Image8 pictureOf(const fs::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool linear = ending == ".exr" || ending == ".hdr" || ending == ".pfm";
    return linear ? displayed(readImage(path, 3)) : readImage8(path, 3);
}

// Code values as 0 ... 1.
Image codesOf(const Image8& image) {
    Image result{image.width, image.height, image.channels, {}};
    for (const std::uint8_t code : image.pixels)
        result.pixels.push_back(static_cast<float>(code) / 255);
    return result;
}

struct Measures {
    double rmse = 0, ssim = 0;
    Image lumaOfTest, lumaOfReference, similarity;
    FlipError flip;
    PredictedDifference predicted;
};

Measures measuresOf(const Image8& test, const Image8& reference, const Display& display,
                    bool withMaps) {
    Measures result;
    result.rmse = compare(codesOf(test), codesOf(reference)).rms;
    result.lumaOfTest = lumaOf(test);
    result.lumaOfReference = lumaOf(reference);
    const std::vector<bool> all(result.lumaOfTest.pixels.size(), true);
    result.ssim = structuralSimilarity(result.lumaOfTest, result.lumaOfReference, all,
                                       withMaps ? &result.similarity : nullptr);
    result.flip = flipError(test, reference);
    result.predicted = predictedDifference(test, reference, display, withMaps);
    return result;
}

// A map below what it is, and above its scale from nothing to `full`.
Image8 mapPage(const Image8& map, const std::string& title, const std::string& none,
               const std::string& full, const Image8& scale) {
    constexpr int margin = 12, head = 34, foot = 52, least = 560;
    const int width = std::max(map.width, least);
    Canvas page(width + 2 * margin, map.height + head + foot);
    page.text(margin, 8, escaped(title), 15);
    page.image(margin, head, map);
    page.frame(margin, head, map.width, map.height);
    const int top = head + map.height + 8;
    page.image(margin, top, scale);
    page.frame(margin, top, scale.width, scale.height);
    page.text(margin, top + scale.height + 4, escaped(none), 13);
    constexpr int letter = 7; // the width of one, about
    page.text(margin + scale.width - letter * static_cast<int>(full.size()), top + scale.height + 4,
              escaped(full), 13);
    return page.finish();
}

Image ramp(float low, float high) {
    constexpr int width = 480, height = 14;
    Image result{width, height, 1, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            result.pixels.push_back(low + (high - low) * static_cast<float>(x) / (width - 1));
    return result;
}

void writeMaps(const fs::path& folder, const Measures& measures, const Display& display) {
    constexpr float fullDifference = 0.25F, fullDissimilarity = 0.5F;
    fs::create_directories(folder);
    const Image zero{480, 14, 1, std::vector<float>(std::size_t{480} * 14, 0)};
    writePng(folder / "difference.png",
             mapPage(signedError(measures.lumaOfTest, measures.lumaOfReference, fullDifference),
                     fmt::format("Difference of luma (RMSE of all channels {:.4f})", measures.rmse),
                     "darker by 0.25 of white or more", "brighter by 0.25",
                     signedError(ramp(-fullDifference, fullDifference), zero, fullDifference)));
    const auto page = [&](const char* name, Image map, float full, const std::string& title,
                          const std::string& most) {
        writePng(folder / name, mapPage(magma(map, full), title, "0: no difference", most,
                                        magma(ramp(0, full), full)));
    };
    Image dissimilarity = measures.similarity;
    for (float& value : dissimilarity.pixels)
        value = 1 - value;
    page("ssim.png", std::move(dissimilarity), fullDissimilarity,
         fmt::format("1 - SSIM of luma (mean SSIM {:.4f})", measures.ssim), "0.5 or more");
    page("flip.png", measures.flip.map, 1, fmt::format("FLIP (mean {:.4f})", measures.flip.mean),
         "1: as large as can be");
    page("jod.png", measures.predicted.map, 1,
         fmt::format("Predicted JOD {:.3f} (ColorVideoVDP; {:.1f} pixels per degree)",
                     measures.predicted.jod, display.pixelsPerDegree()),
         "1: all 10 JOD lost there");
}

int runCompare(const CompareOptions& options) {
    const Display display = displayOf(options.display);
    const Image8 test = pictureOf(options.test), reference = pictureOf(options.reference);
    if (test.width != reference.width || test.height != reference.height)
        throw Error(fmt::format("expected two pictures of one size, found {} of {} x {} and {} of "
                                "{} x {} pixels",
                                options.test.string(), test.width, test.height,
                                options.reference.string(), reference.width, reference.height));
    const Measures measures = measuresOf(test, reference, display, !options.maps.empty());
    if (!options.maps.empty())
        writeMaps(options.maps, measures, display);
    const auto number = [](double value) {
        return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
    };
    if (options.json) {
        nlohmann::ordered_json shownOn;
        for (const auto& [key, value] : numbersOf(display))
            shownOn[key] = value;
        const nlohmann::ordered_json json{{"test", options.test.string()},
                                          {"reference", options.reference.string()},
                                          {"width", test.width},
                                          {"height", test.height},
                                          {"display", shownOn},
                                          {"rmse", measures.rmse},
                                          {"ssim", number(measures.ssim)},
                                          {"flip", measures.flip.mean},
                                          {"jod", measures.predicted.jod}};
        fmt::print("{}\n", json.dump(2));
        return 0;
    }
    fmt::print("RMSE  {:.5f}  of code values, 0 ... 1\n"
               "SSIM  {:.5f}  of luma\n"
               "FLIP  {:.5f}  as from 0.7 m before a 4K screen of 0.7 m\n"
               "JOD   {:.3f}    predicted by ColorVideoVDP; 10: no difference seen\n"
               "Display: {}\n",
               measures.rmse, measures.ssim, measures.flip.mean, measures.predicted.jod,
               inWords(display));
    if (!options.maps.empty())
        fmt::print("Maps: {0}/difference.png, ssim.png, flip.png, jod.png\n",
                   options.maps.string());
    return 0;
}

} // namespace

std::function<int()> addCompare(CLI::App& app) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand(
        "compare", "how far apart two pictures are: RMSE, SSIM, FLIP and predicted JOD");
    command->add_option("test", options->test, "picture; EXR, HDR and PFM are linear light")
        ->required();
    command->add_option("reference", options->reference, "picture of the same size")->required();
    command->add_option("--display", options->display,
                        "that shows them, for JOD: standard_fhd, standard_4k or laptop, or a "
                        "number of it (width, height, diagonalInches, distanceCm, peak, contrast, "
                        "ambientLux), as in peak=120; may be repeated");
    command->add_flag("--json", options->json, "print rmse, ssim, flip and jod as JSON");
    command->add_option("--maps", options->maps, "write maps of the difference into this folder");
    return [options] { return runCompare(*options); };
}

} // namespace obscura
