#include "experiment/ledger_command.h"

#include "base/error.h"
#include "experiment/continuity.h"
#include "experiment/data_folder.h"
#include "experiment/ledger.h"
#include "protocols/reader/protocol_argument.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <string>

namespace obscura {

namespace {

void print(const SlotRecord& record) {
    fmt::print("{:4}  {:9}  {:12}  session {}  {}{}\n", record.slot, nameOf(record.state),
               record.session.participant, record.session.number, record.time,
               isOrphan(record) ? "  its process has died; --void gives the slot back" : "");
}

bool confirm(const std::string& doubt) {
    if (!::isatty(STDIN_FILENO))
        throw Error(doubt + ". Give it back with --yes if you are sure");
    fmt::print(stderr, "{}. Give it back? [y/N] ", doubt);
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "Y" || answer == "yes";
}

// False when the person thinks better of it.
bool giveBack(Ledger& ledger, const LedgerCommand& command) {
    for (const SlotRecord& record : ledger.records())
        if (record.slot == command.returned && !command.yes)
            if (const std::string doubt = doubtOf(record); !doubt.empty() && !confirm(doubt))
                return false;
    ledger.giveBack(command.returned);
    return true;
}

} // namespace

void declareLedger(CLI::App& app, LedgerCommand& command) {
    CLI::App* ledger = app.add_subcommand(
        "ledger", "List who has which slot of the ordering scheme, or give a slot back");
    takesProtocol(ledger->add_option("--protocol", command.protocol, "The study: a TOML file"))
        ->required();
    ledger->add_option("--data", command.data, "The data folder")
        ->type_name("DIR")
        ->capture_default_str();
    ledger
        ->add_option("--void", command.returned,
                     "Give slot N back, so that the next participant gets it; asks when the slot "
                     "was completed, or is held by another machine")
        ->type_name("N")
        ->check(CLI::Range(1, highestSlot));
    ledger->add_flag("--yes", command.yes, "Answer yes to what --void asks");
    ledger->add_flag("--restore", command.restore,
                     "Add the sessions beside a lost or shortened ledger that it does not know");
}

int editLedger(const LedgerCommand& command) {
    const DataFolder folder(command.data, readProtocol(command.protocol));
    Ledger ledger(folder.ledger());
    if (command.restore)
        ledger.restore(lostFromLedger(folder));
    const bool done = command.returned == 0 || giveBack(ledger, command);
    for (const SlotRecord& record : ledger.records())
        print(record);
    for (const SlotRecord& record : lostFromLedger(folder))
        fmt::print(stderr, "obscura-experiment: slot {} of {} is missing; --restore adds it\n",
                   record.slot, record.session.participant);
    return done ? 0 : 1;
}

} // namespace obscura
