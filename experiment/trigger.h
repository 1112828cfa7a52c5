#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace obscura {

// That a phase of a trial came on the screen.
struct Mark {
    double onset = 0;         // seconds on the session's clock
    double age = 0;           // seconds since then
    int trial = 0, phase = 0; // which, from 1
    std::string_view name;    // of the phase: letters, digits, "_" and "-"
};

// Tells a receiver of each onset as soon as it is known, beside recordings of eyes or brains. Never
// waits and never allocates: what a slow or vanished receiver does not take is dropped and counted.
class Trigger {
  public:
    virtual ~Trigger() = default;

    void send(const Mark& mark);
    void restart() { counts_ = {}; } // of another session
    // `sent`, `dropped`, and from the onset until what was sent had been handed to the system:
    // `delay_mean_ms` and `delay_max_ms`, null when nothing was.
    nlohmann::ordered_json counts() const;

  protected:
    // `line` is the mark as a line of JSON with its line feed, and a 0 after that. False when it
    // cannot be handed over at once.
    virtual bool deliver(std::string_view line, const Mark& mark) = 0;
    // One of those handed over turned out not to have arrived.
    void lost();

  private:
    struct Counts {
        int sent = 0, dropped = 0;
        double delay = 0, longest = 0; // seconds, of those that were handed over
        int delays = 0;
    };
    Counts counts_;
};

} // namespace obscura
