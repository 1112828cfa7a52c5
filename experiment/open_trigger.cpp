#include "experiment/open_trigger.h"

#include "base/error.h"
#include "experiment/trigger_receivers.h"

#include <fmt/format.h>

#include <regex>

namespace obscura {

std::unique_ptr<Trigger> openTrigger(const std::string& receiver) {
    static const std::regex address(
        R"((tcp|udp)://(\[([0-9A-Fa-f:.%\w]+)\]|[^:/\[\]]+):(\d{1,5}))");
    static const std::string serial = "serial:";
    std::smatch part;
    try {
        if (receiver == "lsl")
            return openLsl();
        if (receiver.starts_with(serial + "/"))
            return openSerial(receiver.substr(serial.size()));
        if (std::regex_match(receiver, part, address))
            if (const int port = std::stoi(part[4]); port >= 1 && port <= 65535)
                return openSocket(part[1] == "tcp", part[3].matched ? part[3] : part[2], part[4]);
    } catch (const Error& error) {
        throw Error(fmt::format("--trigger {}: {}", receiver, error.what()));
    }
    throw Error(fmt::format("--trigger: expected tcp://HOST:PORT, udp://HOST:PORT, "
                            "serial:/dev/NAME or lsl, found \"{}\"",
                            receiver));
}

} // namespace obscura
