#pragma once

#include "base/error.h"

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace obscura {

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

} // namespace obscura
