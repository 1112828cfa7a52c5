#pragma once

#include "gl/context.h"
#include "viewer/painter.h"
#include "viewer/test_results.h"

#include <functional>
#include <string>
#include <vector>

namespace obscura {

// The test mode of the Leeds thesis (3.5, 4.2): every technique from every camera for some seconds,
// in several rounds, the mean frames per second of each, and a screenshot. Ours: the order is drawn
// anew in each round, so that what drifts (clocks, heat) favours nobody; each frame is drawn as if
// everything had changed, G-buffer and light too, and is not shown, so that no display limits it;
// each pass is timed.
class TestMode {
  public:
    // An Error where the plan cannot be carried out, or its folder has results. A context must be
    // current, here and in next().
    TestMode(TestPlan plan, const gl::Driver& driver, const gl::TimingChoice& timing);

    // Draws the next frame; false when there is none left. After each round, what there is so far
    // is written: test.csv, passes.csv and table.txt, each whole or not at all; screenshots in the
    // first round.
    bool next();
    double share() const;                                      // done, 0 ... 1
    std::string now() const;                                   // "round 1 of 3: nave, gtao"
    const std::vector<TestRow>& rows() const { return rows_; } // of finished rounds

  private:
    struct Entry {
        std::size_t camera, technique;
    };

    void beginRound();
    void beginEntry();
    void open(const View& view);
    Drawn drawWhole();
    void endEntry(const Drawn& last);
    void write() const;
    const View& camera() const { return plan_.cameras[order_[at_].camera]; }
    const TechniqueSetting& technique() const { return plan_.techniques[order_[at_].technique]; }

    TestPlan plan_;
    TestMachine machine_;
    Painter painter_;
    std::vector<Entry> order_; // of this round
    int round_ = 0;            // from 1, once begun
    std::size_t at_ = 0;       // in the order
    std::string opened_;       // the scene
    SceneId scene_ = 0;
    Wanted wanted_;
    TestRow row_; // of the entry, its times summed up; round 0 before it begins
    std::vector<TestRow> rows_, finished_;
};

// The same in a context and with scenes of its own, on the thread that calls it. `step` is called
// after every frame with the share done and what goes on, and ends the test by returning false:
// what whole rounds gave is kept. Gives the rows of whole rounds.
using TestStep = std::function<bool(double share, const std::string& now)>;
std::vector<TestRow> runTest(const TestPlan& plan, const TestStep& step,
                             const std::string& device = "");

} // namespace obscura
