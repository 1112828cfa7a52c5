#include "stimuli/again.h"

#include "image/image.h"
#include "stimuli/boost.h"
#include "stimuli/image_files.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace obscura {

namespace {

// How far apart; nothing where they are the same to the last bit, so that a NaN equals itself.
template <typename Pixel>
std::optional<OtherPixels> apart(const FileRecord& file, const std::vector<Pixel>& before,
                                 const std::vector<Pixel>& now, double unit) {
    if (before.size() == now.size() &&
        (now.empty() || std::memcmp(before.data(), now.data(), now.size() * sizeof(Pixel)) == 0))
        return std::nullopt;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (before.size() != now.size())
        return OtherPixels{file, infinite, infinite};
    OtherPixels result{file};
    double sum = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double difference =
            (static_cast<double>(now[i]) - static_cast<double>(before[i])) / unit;
        // What one has and the other not (NaN) is as far apart as can be.
        const double size = std::isnan(difference) ? infinite : std::abs(difference);
        sum += size * size;
        result.largest = std::max(result.largest, size);
    }
    result.rms = std::sqrt(sum / static_cast<double>(now.size()));
    return result;
}

std::optional<OtherPixels> apart(const Manifest& manifest, const FileRecord& file,
                                 const Image8& now) {
    return apart(file, readImage8(manifest.folder / file.path, now.channels).pixels, now.pixels,
                 255);
}

std::optional<OtherPixels> apart(const Manifest& manifest, const FileRecord& file,
                                 const Image& now) {
    return apart(file, readExr(manifest.folder / file.path, channelNames(now.channels)).pixels,
                 now.pixels, 1);
}

} // namespace

bool decidedByPixels(const std::string& difference) {
    return difference.starts_with("codeSha256: ") || difference.starts_with("shaderSha256: ") ||
           difference.starts_with("programVersion: ");
}

std::vector<OtherPixels> otherPixels(const Manifest& manifest, const ImageRecord& record,
                                     const Rendering& now) {
    std::vector<OtherPixels> all;
    const auto add = [&](std::optional<OtherPixels> other) {
        if (other)
            all.push_back(std::move(*other));
    };
    add(apart(manifest, renderedOf(record), now.image));
    const auto images = exrsOf(now);
    for (const auto& [kind, file] : record.layers)
        if (kind == "ao")
            add(apart(manifest, file, quantised(now.visibility)));
        else if (record.derived && &file == &renderedOf(record))
            continue;
        else if (const auto image = images.find(kind); image != images.end())
            add(apart(manifest, file, *image->second));
        else
            add(OtherPixels{file, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::infinity()});
    return all;
}

} // namespace obscura
