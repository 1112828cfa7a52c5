#pragma once

#include "experiment/data_folder.h"
#include "experiment/display.h"
#include "experiment/pages.h"
#include "experiment/study.h"
#include "experiment/viewing.h"

namespace obscura {

// How long a session of the study takes, in seconds: the times that it fixes, and for the rest the
// means of its stated model of looking and deciding (docs/protocols.md, [simulation]).
double expectedSeconds(const Protocol& protocol);

// What the experimenter reads before a session; `monitor` of `monitors`, from 1.
StartFacts startFacts(const Study& study, const DataFolder& folder, bool rehearsal,
                      const StimulusDisplay& display, const Viewing& viewing, int monitor,
                      int monitors);

} // namespace obscura
