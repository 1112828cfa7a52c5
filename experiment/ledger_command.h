#pragma once

#include <CLI/App.hpp>

#include <filesystem>

namespace obscura {

// obscura-experiment ledger: who has which slot; gives slots back, restores a lost ledger.
struct LedgerCommand {
    std::filesystem::path protocol, data = "participant_data";
    int returned = 0; // slot to give back
    bool yes = false, restore = false;
};

void declareLedger(CLI::App& app, LedgerCommand& command);
int editLedger(const LedgerCommand& command); // exit status; 1 when the person thinks better of it

} // namespace obscura
