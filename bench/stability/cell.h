#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace obscura {

// The numbers of the stability tests, which show where methods fail, as they stand in
// stability.csv.

// A failure test: one column of the heat map. Values are errors: 0 is perfect, the sign says which
// way (docs/stability.md), NaN that a technique has no answer.
struct StabilityTest {
    std::string_view id;      // in the CSV and in pictures' names: "halo"
    std::string_view title;   // "Halo behind a pole"
    std::string_view setUp;   // what is rendered and how it is measured: a sentence
    std::string_view measure; // the headline among its measures: "occlusion of the wall"
    double pass;              // |headline| up to this is no failure
    double fail;              // from this on it is as bad as it gets: where the colour scale ends
};

// One number of one configuration. Each test gives a headline (the measure that the test names) and
// perhaps more numbers, which the page lists where the headline is picked.
struct StabilityCell {
    std::string configuration; // "hbao", or "hbao steps=8": what tells it from others
    std::string technique;     // id in the table
    std::string test;          // StabilityTest::id
    std::string measure;       // words
    double value = std::numeric_limits<double>::quiet_NaN();
    std::string picture = {}; // PNG or GIF in the result folder ("pictures/halo-hbao.png"), "" when
                              // there is none; the page shows those of headlines
    std::string note = {};    // what the number alone does not say, a few words
};

} // namespace obscura
