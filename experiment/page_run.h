#pragma once

#include "experiment/observer.h"
#include "experiment/recorder.h"
#include "experiment/row.h"

#include <set>
#include <string>
#include <string_view>

namespace obscura {

// How a protocol's pages around the trials ended.
struct PagesEnd {
    bool finished = false; // all were; otherwise the person left, or an answer ended it:
    std::string endedBy;   // of which question
};

// Shows the pages `kind`, "before" or "after" the trials, each once, and records each when it is
// ended. Until the last question that can end the session has been answered nothing is recorded,
// and when it is ended nothing but the answer that did it: without consent there are no data. The
// person is then told so. `done`: pages, by their keys, that were ended before the session broke
// off.
PagesEnd runPages(const Context& context, std::string_view kind, const std::set<std::string>& done,
                  Observer& observer, Recorder& recorder);

} // namespace obscura
