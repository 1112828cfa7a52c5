#pragma once

#include "protocols/reader/boost.h"
#include "protocols/reader/keys.h"
#include "protocols/reader/ordering.h"
#include "protocols/reader/screen.h"
#include "protocols/reader/study.h"
#include "protocols/reader/trial.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// A study as one TOML file says it. parseProtocol() checks everything that needs neither the
// technique table nor a scene file: what it returns has no unknown key, wrong type, value out of
// range, or pair whose members differ in more than the technique. docs/protocols.md has each key.

// How a simulated participant answers; never used for real ones.
struct SimulatedChoice {
    double chooseB = 0.5; // probability of choosing member b, before position bias
};

// An image of a condition: what it is there, and the technique that it is rendered with.
struct Role {
    std::string name;      // "a", "b", "reference"; lower-case letters and digits
    std::string technique; // name of one of `techniques`
};

// Images alike in everything but the technique.
struct Condition {
    std::string id;
    std::string view;  // name of one of `views`
    std::string level; // name of one of `levels`
    std::string hypothesis;
    std::vector<Role> roles; // sorted by name; those of a pair are a and b
    SimulatedChoice simulated;
    std::string correct = {}; // the right answer; "" where there is none
    Place place = {};
};

// Everything that participants read in one language, UTF-8. A study says what it asks; the rest is
// English unless it says otherwise, so that a study in another language can translate all of it.
struct Texts {
    std::string language; // a BCP 47 tag; "" where the protocol does not say
    std::string name;     // of the language, in itself, for those who choose one

    std::string instructions, start, question, first, second, thanks;
    std::string progress = "{pair} / {pairs}";    // above `start`, with the numbers put in
    std::string space = "Space", enter = "Enter"; // the keys' names
    std::string done = "Done";                    // ends a page of several questions
    std::string between = "Up and Down go from one question to another.";
    std::string anyKey = "Press any key to end.";
    std::string loading = "Loading the pictures. Please wait.";
    std::string unfocused = "The keyboard is elsewhere: click here to go on";
    std::string leave = "End the session?", leaveNote = "Answers given so far are kept.";
    std::string stay = "Continue", end = "End";
    std::string declined = "The session ends here. Thank you for your time!";
    std::string rest = "Take a break. Press the space bar to go on.";
    std::string id = "Type the participant's pseudonym and press Enter.";
    std::string idNote = "Letters and digits. Escape ends the program.";
    std::string idMalformed = "A pseudonym is 1 to 32 letters (a-z) and digits.";
    std::string idTaken = "There are data of this participant and session. Type another "
                          "pseudonym, or press Escape and start with another --session.";
    std::string rehearsal = "Rehearsal: answers do not count"; // above every page, and so is
    std::string untimed = "Untimed display: not suitable for data collection";
    std::string resume = "This session broke off after {pair} of {pairs}. Go on from there?";
    std::string otherId = "Another pseudonym";

    std::map<std::string, std::string, std::less<>> own; // texts that the trial's phases name, and
                                                         // that are none of the above
    std::map<std::string, Place, std::less<>> places;    // of the keys that the protocol has
    std::string table = "texts"; // where the protocol has them; or languages.TAG

    // The text of a key, either kind; the parser has made sure that those of the trial exist.
    const std::string& at(std::string_view key) const;
};

struct TextKey {
    std::string_view name; // under [texts]
    std::string Texts::*text;
    bool compulsory = false;
};
std::span<const TextKey> textKeys();

// The stated model of simulated reaction: times are ex-Gaussian (mean and standard deviation of
// the Gaussian part, mean of the exponential part), in seconds.
struct ExGaussian {
    double mean = 0, deviation = 0, tail = 0;
};
struct Simulation {
    double positionBias = 0; // added to the probability of choosing the second image, -0.5 ... 0.5
    ExGaussian view{3.0, 0.8, 2.0};
    ExGaussian decision{0.9, 0.2, 0.5};
};

struct Protocol {
    std::string name; // lower-case letters, digits and hyphens; names the data folder
    std::string title;
    std::uint64_t seed = 0;
    int width = 1280, height = 720;
    int antialiasing = 4; // jittered frames averaged per image
    Normals normals = Normals::smooth;
    std::vector<View> views;
    std::vector<Level> levels;
    std::vector<TechniqueSetting> techniques;
    std::vector<Condition> conditions;
    std::optional<Boost> boost; // nothing: images are shown as they were rendered
    Trial trial;
    std::vector<Phase> before, after; // pages around the trials, each shown once
    Keys keys;
    ScreenNeeds screen;
    Ordering ordering;
    Texts texts;                     // of the first language, or the only one
    std::vector<Texts> translations; // the others, in the order of the file
    Simulation simulation;

    std::filesystem::path path; // where it was read; "" when parsed from text
    std::string sha256;         // of the file's bytes, and of those of files it includes

    // By name; the parser has made sure that those of a condition exist.
    const View& view(const std::string& name) const;
    const Level& level(const std::string& name) const;
    const TechniqueSetting& technique(const std::string& name) const;
    // The texts of every language, at least one.
    std::vector<const Texts*> languages() const;
};

// `file` is the name that errors give. Throws Error with line and column.
Protocol parseProtocol(const std::string& text, const std::string& file);
Protocol readProtocol(const std::filesystem::path& path);

} // namespace obscura
