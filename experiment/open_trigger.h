#pragma once

#include "experiment/trigger.h"

#include <memory>
#include <string>

namespace obscura {

// A line of JSON for each onset goes to tcp://HOST:PORT, udp://HOST:PORT, or, where the library of
// Lab Streaming Layer is found, to the outlet "Obscura" (lsl); a byte, the number of the phase, to
// serial:/dev/NAME (115,200 baud, 8N1). An Error when the text is none of these, or nobody listens.
std::unique_ptr<Trigger> openTrigger(const std::string& receiver);

} // namespace obscura
