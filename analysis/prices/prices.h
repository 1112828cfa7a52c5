#pragma once

#include "analysis/scales/scale_kinds.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What techniques cost, and what people and a metric see of them: milliseconds and predicted JOD
// from the stimuli's manifest beside the JOD of people's choices.

// One technique, in one scene and level or in all of them together. Its JOD are differences from
// one technique of the same scale, the reference, whose own are 0; below 0 is worse.
struct Priced {
    std::string name;                   // in the protocol
    std::string technique;              // id in the technique table
    std::optional<double> milliseconds; // 0 for "none"; over several scenes their geometric mean
    double people = 0;
    std::optional<double> standardError;
    OpenInterval interval;           // 95 %; of the reference 0 to 0
    std::optional<double> predicted; // over several scenes the mean, and so is `rmse`
    std::optional<double> rmse;      // of visibility against the ray-traced one, 0 to 1
};

// From where on more milliseconds buy nothing. What is dearer is everything that costs more, and
// the reference in any case.
struct Plateau {
    std::size_t technique = 0;
    // By how much the dearer ones may be better: the greatest upper end of the 95 % intervals.
    double most = 0;
    std::string seen;    // a dearer technique whose interval lies wholly above 0; "" for none
    OpenInterval seenBy; // its interval
};

struct PricedScale {
    const ScaleKind* kind = nullptr;
    ScaleGroup group;
    std::string intervals;          // how they came about
    std::vector<std::string> notes; // of the scale
    // By rising price; the reference last where it has none of its own.
    std::vector<Priced> techniques;
    std::size_t reference = 0;
    bool isTraced = false; // the reference is `ray_traced`; else it is the dearest technique
    // Techniques that cost more than each before them and that people like better, as estimated.
    std::vector<std::size_t> front;
    // The cheapest below the reference than which nothing dearer is better by `noticeableJod`: the
    // upper ends of all intervals lie below that. It takes every one of these one-sided tests at
    // 2.5 %, and so needs no correction (Berger, Technometrics 24 (1982) 295).
    std::optional<Plateau> enough;
    // The cheapest than which nothing dearer is shown to be better: no lower end lies above 0. This
    // shows nothing, for people may have been too few.
    std::optional<Plateau> untold;

    bool seesAll() const;   // each technique below the reference is shown to fall short
    bool hasPrices() const; // somebody measured what a technique costs
};

// JOD: 63 of 100 would choose the better one.
constexpr double noticeableJod = 0.5;

// Of every leading scale in JOD; techniques that the stimuli do not tell the price of are left out
// as long as others have one.
std::vector<PricedScale> pricedScales(const ScaleFindings& scales, const Manifest& stimuli);

} // namespace obscura
