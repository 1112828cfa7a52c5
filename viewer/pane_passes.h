#pragma once

#include "gl/timer.h"
#include "viewer/truth.h"
#include "viewer/view_buffers.h"

#include <list>
#include <map>
#include <string>
#include <vector>

namespace obscura {

// Times the pieces of one picture's drawing, all read at its end.
class PieceClock {
  public:
    explicit PieceClock(gl::Timing timing) : timer_(timing) {}

    void start() {
        timer_.start();
        count_ = 0;
    }
    // Here a piece ends; its number.
    std::size_t mark() {
        timer_.mark();
        return count_++;
    }
    std::vector<double> milliseconds(); // of each piece; waits

  private:
    gl::Timer timer_;
    std::size_t count_ = 0;
};

// The techniques that panes show, compiled, with what they gave; and some that were shown before.
// What is compiled serves all values of its settings but those of whole-number ones.
class PanePasses {
  public:
    struct Pane {
        Pane(const Settings& wantedSettings, OcclusionPasses compiledPasses)
            : settings(wantedSettings), passes(std::move(compiledPasses)) {}

        Settings settings; // the newest
        OcclusionPasses passes;
        std::string compiled;      // all that the shaders depend on
        int width = 0, height = 0; // of its buffers, guard band included
        int guard = 0;
        std::uint64_t wanted = 0;  // when it was last
        bool cold = true;          // never run: drivers compile at the first run too
        std::string from;          // text of what its result was made from; "" before it ran
        std::uint64_t version = 0; // of the result: another number, another content
        gl::Texture traced;        // the result, where it is ray-traced
        const gl::Texture* visibility = nullptr; // the result
        std::vector<PassDrawn> times;            // of the run that gave it
        std::size_t firstPiece = 0;              // of those times
    };

    // One for each pane that is wanted, compiled where it must be, which `before` is told. They
    // stay where they are until the next call. An Error loses nothing.
    std::vector<Pane*> take(const Wanted& wanted, const PaintProgress& before);

    // Runs a pane whose result is not of these buffers. One that is ray-traced takes what was
    // traced, and without that is open. False where there was nothing to do.
    bool run(Pane& pane, const ViewBuffers& buffers, const Subject& subject, const Truth* truth,
             PieceClock& clock);
    void forgetResults(); // those of another scene

  private:
    Pane* known(const Settings& settings, bool exactly);
    Pane& compiled(const Settings& settings, const Wanted& wanted);
    static void adapt(Pane& pane, const Settings& settings, const Wanted& wanted);

    std::list<Pane> panes_;
    std::map<std::string, double> seconds_; // that compiling took, by technique
    std::uint64_t turn_ = 0, versions_ = 0;
};

} // namespace obscura
