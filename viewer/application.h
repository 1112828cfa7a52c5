#pragma once

#include "viewer/command_line.h"
#include "viewer/panels.h"
#include "viewer/window.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace obscura {

// The viewer: a window, a worker that draws, and what a person has set. The thread of the window
// draws panels and finished pictures, and sleeps while nothing changes; whatever may take long is
// done by the worker.
class Application {
  public:
    explicit Application(const CommandLine& line);
    ~Application();

    // Until the window is closed or, with --picture, that is saved.
    void run();
    // Sleeps until something happens, at most so many seconds, and draws a frame.
    void step(double atMost = 0.1);

    const State& state() const { return state_; }
    // Where a widget or picture was drawn last, by its label; nothing where it was not.
    std::optional<Box> where(const std::string& label) const;
    std::shared_ptr<const Drawn> drawn() const { return drawn_; }
    const std::optional<Probed>& probed() const { return probed_; }
    const std::string& message() const { return message_.text; }
    const TestRun* test() const { return test_.get(); }
    // Whether the newest picture shows all that is wanted, with so many rays where one is traced.
    bool settled(int rays = 0);
    int frames() const { return frames_; }                         // drawn so far
    double longestFrame() const { return window_.longestFrame(); } // seconds
    Image8 picture();                                              // draws a frame, and gives it

  private:
    void frame();
    void open(const SceneChoice& choice);
    void name(const SceneChoice& choice);
    std::vector<View> storedOf(const View& view);
    void takeNews();
    void frameScene();
    void takeKeys();
    void press(const KeyPress& key);
    void pressControl(const KeyPress& key);
    void escape();
    void move(const Hand& hand);
    bool fly();
    int framesToSettle() const;
    Box drawPanels();
    void carryOut(const Requests& requests);
    void askForScreenshot();
    void saveScreenshot();
    void addStudy(const Requests& requests);
    void storePresentView();
    void forgetChosenView();
    void startTest();
    void meter(double within);
    void say(const std::string& text, bool error = false);
    Wanted wanted() const;

    CommandLine line_;
    ViewerWindow window_;
    State state_;
    Desk desk_;
    Browser browser_;
    Message message_;
    History history_;
    std::string lastError_;
    SceneId opening_ = 0; // begun, and nothing is known yet; 0 for none
    std::shared_ptr<const Opened> opened_;
    std::shared_ptr<const Drawn> drawn_;
    Status status_;
    std::optional<Probed> probed_;
    std::map<std::string, Box> places_;
    Requests requests_;
    Hand hand_;
    Box area_;
    double wakeIn_ = 0, lastFly_ = 0;
    int settling_ = 4;      // frames that are still to be drawn, whatever happens
    bool pressed_ = false;  // a key, in this frame
    bool metering_ = false; // the first picture of a scene is to say how it is exposed
    std::string flown_;     // keys of flying that were pressed since the last frame
    int frames_ = 0;
    std::unique_ptr<TestRun> test_;
    Uploads uploads_;
    // A screenshot that waits for visibilities from the drawing thread.
    struct Shot {
        std::shared_ptr<const Drawn> drawn;
        std::mutex mutex;
        bool taken = false;
        std::vector<Image> visibilities;
    };
    std::shared_ptr<Shot> shot_;
    std::unique_ptr<Worker> worker_; // its context is the window's: dies before it
};

// The program with a window, as the command line says. Gives the exit status.
int runWindow(const CommandLine& line);

} // namespace obscura
