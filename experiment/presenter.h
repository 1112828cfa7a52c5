#pragma once

#include "experiment/display.h"
#include "experiment/observer.h"
#include "experiment/text.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// A person before a display: shows the study's images and pages, passes on keys and clicks. All
// images and the question are in graphics memory, and have been drawn once, before the first trial.
class Presenter : public Observer {
  public:
    // `warning` stands above every page of text; "" for none.
    Presenter(Display& display, const Study& study, std::string warning);

    // Asks for the participant's id until `objection` has none; nothing when Escape was pressed.
    std::optional<std::string>
    askId(const std::function<std::string(const std::string&)>& objection);

    Refresh refresh() const override { return display_.refresh(); }
    void describe(nlohmann::ordered_json& sidecar) const override { display_.describe(sidecar); }
    bool instruct() override;
    void prepare(const Upcoming& trial) override;
    double show(Screen screen) override;
    std::vector<Event> events(bool wait) override;
    void thank() override;

  private:
    // A page in graphics memory, and where its options are.
    struct Sheet {
        gl::Picture picture;
        std::vector<Box> options;
    };

    Sheet sheet(Page page) const;
    gl::Picture load(const Manifest& manifest, const ImageRecord& record);
    double showPicture(const gl::Picture* picture, const Sheet* sheet);
    int optionAt(int x, int y) const;
    std::vector<Event> answers();
    void turnTo(const Sheet& page);
    bool read(const Sheet& page);
    bool leaves();

    Display& display_;
    const Study& study_;
    std::string warning_;
    std::vector<std::array<gl::Picture, 2>> pairs_; // by condition: members a and b
    Sheet start_, question_, leave_;
    const gl::Picture* first_ = nullptr; // of the prepared trial
    const gl::Picture* second_ = nullptr;
    const gl::Picture* shown_ = nullptr;
    const Sheet* shownSheet_ = nullptr; // when a page is shown
};

} // namespace obscura
