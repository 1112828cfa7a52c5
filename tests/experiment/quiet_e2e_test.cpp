// Between the first onset of a trial and its question nothing may hold up a frame: the real session
// before a real window, as the program runs it.
#include "base/files.h"
#include "experiment/presenter.h"
#include "experiment/session.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/quiet.h"
#include "tests/experiment/receiver.h"
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"

#include <epoxy/gl.h>

#include <X11/keysym.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Disturbance;
using Kind = test::Disturbance::Kind;

constexpr int width = 1280, height = 720;

struct Enough {};

// A participant who presses what goes on as soon as the program waits for it, and who listens from
// the first onset of each trial, of an image or grey, to that of its last question. What the
// participant does is not listened to.
class Listener : public Observer {
  public:
    Listener(Presenter& presenter, test::Desktop& desktop, const Protocol& protocol, int trials)
        : presenter_(presenter), desktop_(desktop), phases_(phasesOf(protocol.trial)),
          trials_(trials) {}

    Refresh refresh() const override { return presenter_.refresh(); }
    void describe(nlohmann::ordered_json& sidecar) const override { presenter_.describe(sidecar); }
    bool instruct() override {
        desktop_.tap(XK_space);
        return true;
    }
    void prepare(const Upcoming& trial) override {
        if (trials_-- == 0)
            throw Enough{};
        presenter_.prepare(trial);
    }
    double show(const TrialMachine& trial) override {
        trial_ = &trial;
        const bool wasOn = trial.isOn();
        const double time = presenter_.show(trial);
        if (wasOn)
            return time;
        const auto asks = [](const Phase& phase) { return !phase.questions.empty(); };
        const auto phase = phases_.begin() + trial.screen();
        if (asks(*phase))
            listen(false);
        else if (phase->text.empty() && std::any_of(phase, phases_.end(), asks))
            listen(true);
        return time;
    }
    const std::vector<Event>& events(bool wait) override {
        if (wait && !coming_) {
            const bool was = listening_;
            listen(false);
            press();
            listen(was);
        }
        const std::vector<Event>& events = presenter_.events(wait);
        for (const Event& event : events)
            coming_ = coming_ && event.kind != Event::Kind::release;
        return events;
    }
    void preparePage(const Phase&) override {}
    bool rest() override { return true; }
    void thank() override {}
    void decline() override {}

  private:
    void listen(bool on) {
        listening_ = on;
        test::listen(on);
    }
    void press() {
        coming_ = true;
        const Form* form = trial_->form();
        const auto focus = static_cast<std::size_t>(form ? form->focus() : 0);
        if (!form)
            desktop_.tap(XK_space);
        else if (form->answered(focus))
            desktop_.tap(XK_Return);
        else
            desktop_.tap(XK_1 + form->entries()[focus].ranks.size());
    }

    Presenter& presenter_;
    test::Desktop& desktop_;
    std::vector<Phase> phases_;
    int trials_;
    const TrialMachine* trial_ = nullptr;
    bool listening_ = false;
    bool coming_ = false; // a key was pressed whose release has not come back yet
};

class QuietTest : public testing::TestWithParam<fs::path> {
  protected:
    test::TemporaryFolder folder;
    test::Desktop desktop{width, height};

    void SetUp() override { ::setenv("DISPLAY", desktop.name().c_str(), 1); }

    // What is heard in the first trials of a session of a study.
    std::vector<Disturbance> listenTo(const fs::path& method, int trials) {
        const fs::path protocol = folder.path() / "study.toml", stimuli = folder.path() / "stimuli";
        writeFile(protocol, test::hastened(readFile(method)));
        test::writeNoiseStimuli(readProtocol(protocol), stimuli);
        Study study = openStudy(protocol, stimuli);
        study.protocol.before.clear(); // only trials are listened to
        test::Receiver receiver(SOCK_STREAM);
        StimulusDisplay display(
            {{"quiet", 1, std::nullopt}, study.protocol.trial.grey, true, receiver.url()},
            curtain(study));
        test::listenToOpenGl();
        Presenter presenter(display, study, "");
        Listener listener(presenter, desktop, study.protocol, trials);
        const DataFolder data(folder.path() / "data", study.protocol);
        try {
            runSession(study, data, {"P01", 1, false}, listener);
        } catch (const Enough&) {
        }
        const std::size_t onsets = phasesOf(study.protocol.trial).size() * std::size_t(trials);
        EXPECT_EQ(receiver.lines(onsets).size(), onsets) << "of the trigger, which is quiet, too";
        return test::heard();
    }
};

// What holds up frames is noticed at all, and whose it is.
TEST_F(QuietTest, DisturbancesAreHeard) {
    StimulusDisplay display({{"quiet", 1, std::nullopt}}, [](int w, int h) {
        return Image8{w, h, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(w * h) * 3, 128)};
    });
    test::listenToOpenGl();
    const auto ours = [](const std::vector<Disturbance>& all, Kind kind) {
        return std::count_if(all.begin(), all.end(), [&](const Disturbance& one) {
            return one.kind == kind && one.by == "ours";
        });
    };
    test::listen(true);
    const std::string text(100, 'x');
    const auto number = std::make_unique<int>(1);
    const std::vector<Disturbance> memory = test::heard();
    EXPECT_GE(ours(memory, Kind::allocation), 2) << test::summary(memory) << text << *number;

    test::listen(true);
    std::ifstream("/proc/self/stat");
    const std::vector<Disturbance> files = test::heard();
    EXPECT_GE(ours(files, Kind::file), 1) << test::summary(files);

    test::listen(true);
    glCompileShader(glCreateShader(GL_FRAGMENT_SHADER));
    const gl::Picture picture(1, 1, 3, std::array<std::uint8_t, 3>{});
    const std::vector<Disturbance> drawing = test::heard();
    EXPECT_EQ(ours(drawing, Kind::compilation), 1) << test::summary(drawing);
    EXPECT_EQ(ours(drawing, Kind::upload), 2) << test::summary(drawing);
}

// Of this program there is nothing. Allocations of the driver and of Xlib are theirs, and printed.
TEST_P(QuietTest, NothingHoldsUpATrial) {
    const std::vector<Disturbance> all = listenTo(GetParam(), 3);
    std::printf("heard: %s\n", test::summary(all).c_str());
    int told = 0;
    for (const Disturbance& one : all)
        if (one.kind != Kind::allocation || one.by == "ours") {
            ADD_FAILURE() << test::summary({one}) << "\n" << one.how;
            if (++told == 5)
                break;
        }
}

INSTANTIATE_TEST_SUITE_P(Protocols, QuietTest, testing::ValuesIn(test::shippedStudies()),
                         test::caseName);

} // namespace
} // namespace obscura
