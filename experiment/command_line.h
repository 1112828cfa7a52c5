#pragma once

#include "experiment/ledger_command.h"
#include "experiment/timing_command.h"

#include <CLI/App.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace obscura {

// What obscura-experiment is asked to do.
struct Arguments {
    std::filesystem::path protocol, stimuli, data = "participant_data";
    std::string participant, language;
    int session = 1;
    int monitor = 1;
    std::string screenMm;
    std::string windowSize; // with --windowed; "" for the usual one
    bool windowed = false, rehearse = false, allowUntimed = false, listMonitors = false;
    bool simulate = false, visual = false, resume = false;
    int simulated = 0;                   // how many; 0 as the protocol plans
    std::string observer = "preference"; // or "jod"
    std::optional<std::uint64_t> seed;
    std::filesystem::path preview;
    bool check = false;
    std::string size = "1920x1080"; // of a screen that nobody looks at
    LedgerCommand ledger;
    bool photodiode = false;
    std::string trigger;
    TimingArguments timing;
};

void declare(CLI::App& app, Arguments& arguments);

} // namespace obscura
