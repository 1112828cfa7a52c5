#pragma once

#include "viewer/picture.h"

#include <functional>
#include <memory>

namespace obscura {

// What passes between the painter, whoever waits for it, and the tracer.

// What a reference is the truth of, besides its view.
struct TruthKind {
    Integral integral = Integral::cosine;
    double radius = 0.5; // metres

    bool operator==(const TruthKind&) const = default;
};

// A reference of the view that the painter drew last, as far as it has been traced.
struct Truth {
    TruthKind kind;
    std::shared_ptr<const Image> visibility; // 1 channel, rows from the top
    int rays = 0;                            // a pixel
};

// What a pane is judged by: CPU copies, for another thread to compare.
struct Comparison {
    std::string of; // names what is compared, but for the reference's rays
    struct Pane {
        Image visibility;
        Image8 lit;
    };
    std::vector<Pane> panes;
    Image visibility; // of the reference
    Image8 lit;       // with it
    std::vector<bool> shown;
    Display display;
    int rays = 0;
};

// What came of it, by pane.
struct Judgement {
    std::string of; // the comparison's
    std::vector<Quality> qualities;
    std::vector<Image> jodMaps; // 1 - JOD / 10 at each pixel
};

// What drawing does that may take long.
struct PaintStep {
    enum class Kind { compiling, lighting } kind;
    std::string what;           // "GTAO": the technique's title
    int done = 0, all = 1;      // of the wish's steps of this kind
    double expectedSeconds = 0; // as the same took before; 0 where it never did
};
using PaintProgress = std::function<void(const PaintStep&)>;

} // namespace obscura
