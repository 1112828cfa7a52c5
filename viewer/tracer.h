#pragma once

#include "renderer/frame/surfaces.h"
#include "renderer/reference/reference.h"
#include "viewer/truth.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// Traces references of one view, ever finer, and judges panes by them, on threads of its own that
// run only while nobody else wants the processor (idle priority). A few rays a pixel first, then as
// many again as there are, up to 1024: each set has another seed, and the mean of all is the
// reference. All member functions return at once, and may be called from any thread.
class Tracer {
  public:
    // Called from its threads when traced() or judgement() gives something new, and now and then
    // while it traces. Must return at once, and not call the tracer.
    explicit Tracer(std::function<void()> changed);
    ~Tracer(); // aborts
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    static constexpr int mostRays = 1024; // a pixel

    // What to trace from now on. `view` names the surfaces (Painter::view); another number begins
    // anew. What else was traced of the same view is kept for as long as its kind is wanted.
    void trace(std::uint64_t view, std::shared_ptr<const RayTracer> scene, Surfaces surfaces,
               std::vector<TruthKind> kinds);
    // Other references of the view that is traced.
    void want(std::vector<TruthKind> kinds);
    void stop(); // forgets the view

    struct Traced {
        std::uint64_t view = 0;
        std::vector<Truth> truths; // those with any rays, in the order in which they were wanted
        double share = 1;          // of all rays wanted
        double secondsLeft = 0;    // NaN: not known yet
        std::string error;         // why tracing ended; "" where it did not
    };
    Traced traced() const;

    // Judges, instead of what waits to be judged.
    void judge(Comparison comparison);
    // What came of the newest that was judged; once.
    std::optional<Judgement> judgement();
    bool judging() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace obscura
