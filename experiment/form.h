#pragma once

#include "gl/input.h"
#include "protocols/reader/keys.h"
#include "protocols/reader/trial.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What was answered to a question.
struct FormAnswer {
    std::string name;
    // The number of the option from 1, or "unsure"; the number of a scale or slider; the places of
    // ranked images, best first, as "2>1>3"; what was typed; "" for a question left open.
    std::string value;
    double seconds = 0; // from the page's onset until this value was given
};

// The questions of one page and how far they are answered. A question that stands alone and has
// options is answered by one key or click, of two options by the study's keys. Otherwise one
// question has the focus: Tab, Enter, Up and Down move it, keys give it a value, and Enter on the
// last, the key that goes on, or a click on the page's button ends the page once everything is
// answered that must be.
class Form {
  public:
    enum class Effect { none, changed, finished };

    // What stands for a question so far.
    struct Entry {
        int option = 0;              // choice, scale: from 1; 0 for none
        std::optional<double> value; // slider
        std::vector<int> ranks;      // places of images, best first
        std::string typed;
        double seconds = 0; // when it was last changed
    };

    // `images`: how many the trial shows, which a ranking ranks.
    Form(const std::vector<Question>& questions, int images, Keys keys = {});

    Effect press(gl::Key key, double seconds);
    Effect type(std::uint32_t symbol, double seconds); // a Unicode code point
    // A click on the page's nth target, from 1: those of each question in turn (its options; a
    // ranking's images; one for what is typed or slid), then the button. `share`: how far from the
    // target's left side, 0 ... 1.
    Effect click(int target, double share, double seconds);

    const std::vector<Question>& questions() const { return questions_; }
    const std::vector<Entry>& entries() const { return entries_; }
    int focus() const { return focus_; } // from 0
    bool alone() const { return alone_; }
    int changes() const { return changes_; } // how often what its page shows has changed
    bool answered(std::size_t index) const;
    bool complete() const; // so that the page may end
    std::vector<FormAnswer> answers() const;

    int optionsOf(const Question& question) const; // "unsure" among them
    const Keys& keys() const { return keys_; }

  private:
    Effect noted(Effect effect);
    Effect pressed(gl::Key key, double seconds);
    Effect clicked(int target, double share, double seconds);
    Effect choose(int option, double seconds);
    Effect slide(double value, double seconds);
    Effect move(int step);
    Effect next();
    Effect pressSlider(gl::Key key, double seconds);
    bool typing() const;
    std::string valueOf(std::size_t index) const;
    Entry& entry() { return entries_[static_cast<std::size_t>(focus_)]; }
    const Question& question() const { return questions_[static_cast<std::size_t>(focus_)]; }

    std::vector<Question> questions_;
    std::vector<Entry> entries_;
    int images_;
    Keys keys_;
    int focus_ = 0;
    bool alone_;
    int changes_ = 0;
};

// Whether the study's keys for one of two answer it; otherwise options have the digits.
bool isOfTwo(const Question& question);

// The number that a key stands for: of the digits 0 ... 9, also on the keypad; -1 for none.
int digitOf(gl::Key key);

} // namespace obscura
