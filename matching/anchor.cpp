#include "matching/anchor.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace obscura {

Settings starcraftAnchor(double radius) {
    Settings settings(technique("starcraft"));
    settings.set("radius", radius);
    settings.set("samples", 16);
    settings.set("blur", 1);
    return settings;
}

std::string processorName() {
    std::string model = "unknown";
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; model == "unknown" && std::getline(file, line);)
        if (const auto colon = line.find(": ");
            line.starts_with("model name") && colon != line.npos)
            model = line.substr(colon + 2);
    return fmt::format("{} ({} cores)", model, std::thread::hardware_concurrency());
}

} // namespace obscura
