#pragma once

#include "experiment/form.h"
#include "experiment/text.h"
#include "protocols/reader/protocol.h"

#include <string>

namespace obscura {

// What an experimenter wants to know before a session begins.
struct StartFacts {
    std::string title; // of the study
    std::vector<Page::Fact> facts;
    bool monitors = false; // there are several, and Tab goes to the next
};

// What participants and experimenters read, page by page. Every word comes from the study's
// protocol, or is its English default, so that all can be in the participant's language.

// Which language: each by its name, in its own script. `chosen`: from 0.
Page languagePage(const Protocol& protocol, std::size_t chosen);
Page loadingPage(const Texts& texts, int loaded, int images);
// For the experimenter, before the participant sits down: how things stand, and who takes part.
Page idPage(const Texts& texts, const std::string& typed, const std::string& objection,
            const StartFacts& start = {});
// Whether a session that broke off after `trial` of `trials` is to go on.
Page resumePage(const Texts& texts, int trial, int trials);
Page instructionsPage(const Texts& texts);
// Of a phase of text; `pair` of `pairs` stands above it where the phase shows progress.
Page textPage(const Texts& texts, const Phase& phase, int pair, int pairs);
// What a phase of questions leaves free for its images, all of one size. Where answers mean images,
// below each of several that the trial puts in order stands its place, the number that they have.
Page::Pictures roomFor(const Phase& phase, int width, int height);
// Of a phase that asks, as far as it is answered, with room for the images that it shows; `text`
// names what stands above the questions, as of a consent, or nothing.
Page formPage(const Texts& texts, const Form& form, const Page::Pictures& pictures,
              const std::string& text = "");
Page restPage(const Texts& texts); // a break between trials
Page leavePage(const Texts& texts);
Page thanksPage(const Texts& texts);
Page declinedPage(const Texts& texts); // an answer has ended the session before its trials

// The page as it looks while another window has the keyboard.
Page unfocused(Page page, const Texts& texts);

// An Error names the first text with characters that no installed font can show, where it is in the
// protocol, its language, and those characters.
void checkShowable(const Texts& texts);

} // namespace obscura
