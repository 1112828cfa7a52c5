#pragma once

#include "experiment/trigger.h"

#include <memory>
#include <string>

namespace obscura {

// What openTrigger() opens. Errors say what is wrong with the receiver, not where it stands.
std::unique_ptr<Trigger> openSocket(bool stream, const std::string& host, const std::string& port);
std::unique_ptr<Trigger> openSerial(const std::string& device);
std::unique_ptr<Trigger> openLsl();

} // namespace obscura
