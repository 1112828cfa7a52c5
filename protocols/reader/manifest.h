#pragma once

#include "protocols/reader/display.h"
#include "protocols/reader/protocol.h"

#include <array>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// All that decides the pixels of one image: enough to render it again, byte for byte on the same
// driver. Equal recipes give equal images; what cannot be written out stands here as a hash.
struct Recipe {
    int width = 0, height = 0, antialiasing = 1;
    std::uint64_t seed = 0;
    View view;
    std::string sceneSha256; // of the scene's files; of all that it consists of when built in
    Level level;
    Normals normals = Normals::smooth;
    std::string environmentSha256;          // "" without an environment image
    std::string technique;                  // id in the technique table
    std::map<std::string, double> settings; // every parameter, defaults filled in, radius in metres
    std::string shaderSha256;               // of the text of every shader that made the image
    std::string codeSha256; // of our C++ that renders (imageCode()); "" before version 2
    std::string programVersion;
    std::string glVendor, glRenderer, glVersion;

    std::string json() const; // canonical: keys sorted, no white space
    std::string sha256() const;
};

struct FileRecord {
    std::string path; // relative to the manifest
    std::string sha256;
};

// How an image was made of two that were rendered (Boost).
struct Derivation {
    std::string fromSha256;      // of the image's own rendering,
    std::string reference;       // the role from which it differs
    std::string referenceSha256; // and of that one's
    double amplify = 1;
    int magnify = 1;
    std::array<int, 2> crop{}; // top left corner, pixels

    bool operator==(const Derivation&) const = default;
};

// How far an image is from the reference of its view: the ray-traced image of the same scene, level
// and recipe otherwise. Of what was rendered, before any boost.
struct ImageQuality {
    double rmse = 0;             // of visibility, linear, over pixels that show a surface
    double jod = 10;             // predicted, of the lit image, on Manifest::display
    std::string referenceSha256; // of the reference's recipe

    bool operator==(const ImageQuality&) const = default;
};

struct ImageRecord {
    std::string role; // in its condition: "a", "b", "reference"
    std::string name; // of the technique setting: "blizzard24"
    Recipe recipe;
    std::string
        inputsSha256; // of the G-buffer and light buffers of every jittered frame, before AO
    double meanOcclusion = 0; // 1 - visibility, averaged over the pixels that show a surface
    FileRecord image;         // 8-bit sRGB PNG
    std::map<std::string, FileRecord> layers; // "ao" always; "linear", "albedo", ... on request
    std::optional<Derivation> derived;        // then the layer "rendered" is what the recipe gives
    std::optional<ImageQuality> quality;      // nothing before version 4
    // Median time of the technique's passes for one frame of the image's size, not antialiased, on
    // the machine of Manifest::timing; nothing before version 4, and for techniques that no real
    // time is meant for (ray_traced).
    std::optional<double> milliseconds;
};

struct ConditionRecord {
    std::string condition; // id
    std::string level, view, hypothesis;
    double radius = 0;              // metres, that of every image
    std::deque<ImageRecord> images; // references stay valid while it grows

    const ImageRecord* find(std::string_view role) const; // null when there is none
    // An Error when there is none.
    const ImageRecord& image(std::string_view role) const;
    ImageRecord& image(std::string_view role); // added when there is none
    // Two images, a and b, between which one chooses.
    bool isPair() const { return find("a") && find("b"); }
};

// How and on what the images' times were measured.
struct TimingRecord {
    std::string method;    // a sentence
    std::string renderer;  // of OpenGL
    std::string processor; // of the machine
    // Milliseconds of the anchor in the same rounds, `starcraft` with 16 samples, by view.
    std::map<std::string, double> starcraft;

    bool operator==(const TimingRecord&) const = default;
};

// What obscura-stimuli wrote, and all that the presenter and the report need to know of it.
struct Manifest {
    std::string study, title;
    std::string protocolSha256; // of the file that they were made from
    std::string stimuliSha256;  // of its part that decides stimuli (design.h); "" in manifests
                                // that were written before there was one
    std::string commit;
    int width = 0, height = 0;
    std::vector<ConditionRecord> conditions;
    std::vector<FileRecord> contactSheets; // pages in order
    std::optional<Display> display;        // on which differences were predicted
    std::optional<TimingRecord> timing;

    int schemaVersion = 4;        // of the file that was read
    std::filesystem::path folder; // where it was read from; paths are relative to it
};

// What differs between two recipes, as "settings.radius: 0.3, now 0.4", by the keys of their JSON.
std::vector<std::string> differences(const Recipe& recorded, const Recipe& now);

// manifest.json of a stimulus folder. Reading checks every field and names the one that is amiss.
// A file of an earlier version is read too; what it lacks is empty, and schemaVersion tells.
Manifest readManifest(const std::filesystem::path& path);
// The same of such a file's text; `path` is for errors, and its folder the manifest's.
Manifest parseManifest(const std::string& text, const std::filesystem::path& path);
std::string manifestText(const Manifest& manifest);
void writeManifest(const std::filesystem::path& path, const Manifest& manifest);

} // namespace obscura
