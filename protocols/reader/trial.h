#pragma once

#include "base/error.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

class TomlTable;

// One thing that a participant is asked. Words are keys of [texts].
struct Question {
    // choice: one of the options, or of the images; scale: one of labelled steps, each a whole
    // number; slider: any number in a range; rank: the images, best first; number and text: typed.
    enum class Kind { choice, scale, slider, rank, number, text };

    std::string name; // of the answer, unique in its trial: "choice", "confidence"
    Kind kind = Kind::choice;
    std::string text;                 // what stands above it; "" for nothing
    std::vector<std::string> options; // of choice and scale
    bool images = false;              // choice: option n is the n-th image of the trial's order,
    bool beside = false;              // and the trial shows images beside each other
    std::string unsure;               // choice: one option more, recorded as "unsure"; "" for none
    int lowest = 1;                   // scale: the number of its first option
    double least = 0, most = 100;     // slider and number
    std::string low, high;            // slider: what stands at its ends
    bool optional = false;            // may be left open
    // choice and scale, before the trials: options, of which one must be chosen for the session to
    // go on, as in a consent; empty: any
    std::vector<std::string> endsUnless;
    Place place;
};

// Whether an answer as it is recorded (experiment/form.h) lets the session go on.
bool admits(const Question& question, const std::string& value);

std::string nameOf(Question::Kind kind); // "choice", as protocols spell it

// One step of a trial: what is on the screen, and what ends it. An image is named by its place in
// the trial's order, "1" being the one that comes first, or by its role in the condition.
struct Phase {
    std::string name;                // unique in its trial
    std::vector<std::string> images; // one, or several beside each other
    // Seconds; > 0: at each place `turns` images in turn, each for so long, at all places at once;
    // images[i * turns] is the first of the i-th place.
    double alternate = 0;
    int turns = 1;
    int grey = -1;         // 0 ... 255: nothing but this; -1: something else is shown
    std::string text;      // a page with this text; "" for none
    bool progress = false; // above the text, how far the participant is
    std::vector<Question> questions;

    // Space ends it (on a page of text also a click), but not before it has been on view for
    // `atLeast` seconds. Questions are ended by their answers instead.
    bool key = true;
    double atLeast = 0;
    // It ends by itself after that many seconds, rounded to whole refreshes, or refreshes; 0:
    // never. Each of them is drawn and counted.
    double seconds = 0;
    int frames = 0;
    Place place;

    bool counted() const { return seconds > 0 || frames > 0; }
    // Keys are counted and dropped until it ends.
    bool locked() const { return counted() && !key && questions.empty(); }
};

// A trial: its phases, or, as the protocol's shorthand has it, what says the same of a pair: a page
// that starts it, image 1 until Space, a grey mask, image 2 until Space, and the question which.
struct Trial {
    double mask = 2;          // seconds of grey between the images; cannot be skipped
    int grey = 128;           // code value of mask and surround, 0 ... 255
    double minimumView = 0.5; // seconds during which Space does not yet end an image
    std::vector<Phase> given; // none: the shorthand
    // The roles whose images the order puts at the places 1, 2 and so on.
    std::vector<std::string> order = {"a", "b"};
};

// The phases as they are run.
std::vector<Phase> phasesOf(const Trial& trial);

// Every role that the trial shows or puts in order.
std::set<std::string> rolesOf(const Trial& trial);
bool isOrdered(const Trial& trial, const std::string& role);

// The keys of [texts] that the phases name.
std::set<std::string> textsOf(const std::vector<Phase>& phases);

// Throws Error for a trial that cannot run to its end: a phase that nothing ends, that shows
// nothing or several things at once, names that stand twice.
Trial parseTrial(TomlTable table);

// The pages that are shown once, before the first trial (`key` is "before") or after the last
// ("after"): phases of text and of questions, without images. None where the table has no such key.
std::vector<Phase> parsePages(TomlTable& root, std::string_view key);

} // namespace obscura
