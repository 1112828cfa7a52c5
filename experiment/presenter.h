#pragma once

#include "experiment/display.h"
#include "experiment/observer.h"
#include "experiment/pages.h"
#include "experiment/screens.h"
#include "experiment/viewing.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace obscura {

// Whether a session can be run under an id that was typed.
struct IdVerdict {
    bool accepted = false;
    std::optional<int> broken = {}; // it goes on with one that broke off after so many trials
};

// What a display is to show while the study is being loaded. An Error when one of the study's texts
// cannot be shown.
Curtain curtain(const Study& study);

// A person before a display: shows the study's images and pages, passes on keys and clicks. All
// images and the question are in graphics memory, and have been drawn once, before the first trial.
//
// Keys count only from when a page is on the screen and known to be; from then on the window's
// title says what is there, so that an experimenter can follow on another screen's task bar. A page
// of text says so while another window has the keyboard. An image never does: nothing may be seen
// beside it.
class Presenter : public Observer {
  public:
    // `warning` stands above every page of text; "" for none. Loads the study, showing how far it
    // is.
    Presenter(StimulusDisplay& display, const Study& study, std::string warning);

    // Asks for the participant's id until `judge` has no objection, and, of a session that broke
    // off, until the experimenter confirms that it goes on; nothing when Escape was pressed.
    struct Start {
        std::optional<std::string> id;
        bool otherMonitor = false; // Tab was pressed: nothing begins on this one
    };
    Start askId(const StartFacts& start, const std::function<IdVerdict(const std::string&)>& judge);
    // What session files say of how the images are seen.
    void seenAs(Viewing viewing, nlohmann::ordered_json calibration) {
        viewing_ = std::move(viewing);
        calibration_ = std::move(calibration);
    }

    // For one who is not a person: called before the presenter sleeps, with all on the screen, and
    // again after the seconds that it returns, should nothing arrive before.
    void whileWaiting(std::function<double()> attend) { attend_ = std::move(attend); }
    double now() const { return display_.window().now(); }
    bool hasKeyboard() const { return display_.window().focused(); }

    Refresh refresh() const override { return display_.refresh(); }
    void describe(nlohmann::ordered_json& sidecar) const override {
        display_.describe(sidecar);
        obscura::describe(viewing_, sidecar);
        if (!calibration_.empty())
            sidecar["calibration"] = calibration_;
    }
    void describeOutcome(nlohmann::ordered_json& sidecar) const override {
        display_.describeMarks(sidecar);
    }
    bool instruct() override;
    void prepare(const Upcoming& trial) override;
    void preparePage(const Phase& page) override;
    double show(const TrialMachine& trial) override;
    const std::vector<Event>& events(bool wait) override;
    bool rest() override;
    void thank() override { dismiss(thanksPage(texts_), "thanks"); }
    void decline() override { dismiss(declinedPage(texts_), "declined"); }

  private:
    // A page in graphics memory.
    struct Sheet {
        Screenful screen;
        std::string title; // of the window, as all titles here
        gl::Picture picture;
    };

    // What a phase shows, so that showing it is nothing but drawing.
    struct Prepared {
        std::optional<Sheet> sheet; // of a page of text, and of questions not yet answered
        std::vector<Placed> images;
        int grey = 0;      // behind them
        std::string title; // "" leaves it as it is
    };

    Sheet sheet(Page page, const std::string& title) const; // with the warning above it
    Sheet uploaded(Screenful screen, std::string title) const;
    void loadImages();
    double showScreen(const TrialMachine& trial);
    double showSheet(const Sheet& sheet);
    double showImages(std::span<const Placed> images, int grey);
    const gl::Picture& picture(const std::string& image) const;
    void place(const Screenful& screen, std::vector<Placed>& placed) const;
    void announce();
    const std::vector<gl::Input>& inputs();
    gl::Key asRead(gl::Key key) const;
    Event clicked(const gl::Input& input) const;
    std::vector<Event> answers();
    void turnTo(const Sheet& page);
    bool read(const Sheet& page);
    bool leaves();
    void dismiss(Page page, std::string title);
    int choose(const Sheet& page);
    bool goesOn(int trials);
    Sheet startSheet(const StartFacts& start, const std::string& typed,
                     const std::string& problem) const;

    StimulusDisplay& display_;
    const Study& study_;
    const Texts& texts_;
    Screens screens_;
    Viewing viewing_;
    nlohmann::ordered_json calibration_; // of the screen, as it was kept
    std::vector<Phase> phases_;
    std::vector<std::map<std::string, gl::Picture>> pictures_; // by condition and role
    Sheet leave_;
    std::vector<Prepared> prepared_;    // by phase
    Sheet answered_;                    // a page of questions as far as it is answered,
    std::pair<std::size_t, int> drawn_; // and of which phase, after how many changes
    Upcoming trial_;                    // the prepared one
    const Phase* page_ = nullptr;       // outside trials: the prepared page,
    Prepared preparedPage_;             // and what it shows

    // What is on the screen: a page, or else images or, without one, grey.
    const Sheet* sheet_ = nullptr;
    std::span<const Placed> images_;
    int grey_ = 0;
    bool focused_ = true;   // as the page on the screen has it; if not, the screen shows
    Sheet unfocused_;       // this in its place
    std::string title_;     // what is on the screen, and
    std::string announced_; // what the window's title says
    // Used again and again, so that nothing is allocated while a person looks.
    std::vector<Event> events_;
    std::vector<Placed> placed_; // of the page on the screen
    std::function<double()> attend_;
};

} // namespace obscura
