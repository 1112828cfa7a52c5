#include "experiment/session.h"
#include "protocols/files.h"
#include "protocols/responses.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <sstream>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// Of all files below the folder, while another process writes them.
std::uintmax_t bytesIn(const fs::path& folder) {
    std::uintmax_t sum = 0;
    std::error_code ignored;
    for (fs::recursive_directory_iterator entry(folder, ignored), end; entry != end;
         entry.increment(ignored))
        if (const std::uintmax_t size = entry->file_size(ignored); !ignored)
            sum += size;
    return sum;
}

// Files that are hidden were not finished; nothing reads them.
void expectWhole(const fs::path& dataset) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(dataset)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with('.') || !entry.is_regular_file())
            continue;
        const std::string text = readFile(entry.path());
        if (name.ends_with(".csv")) {
            EXPECT_NO_THROW(readResponses(entry.path(), false)) << name << ":\n" << text;
        } else if (name.ends_with(".json")) {
            EXPECT_TRUE(nlohmann::json::accept(text)) << name << ":\n" << text;
        } else if (name.ends_with(".jsonl")) {
            EXPECT_FALSE(text.empty() && name != "ledger.jsonl") << name;
            std::istringstream lines(text);
            for (std::string line; std::getline(lines, line);)
                EXPECT_TRUE(nlohmann::json::accept(line)) << name << ": " << line;
        }
    }
}

// Killed at sixty different amounts of what it had written, from nothing to a whole session and
// more, a presenter leaves files that are whole, and a folder in which the next session runs.
TEST(Killed, AtAnyMomentLeavesWholeFiles) {
    const test::TemporaryFolder temporary;
    const test::TinyStudy tiny =
        test::writeTinyStudy(temporary.path(), {.width = 16, .height = 16});
    const Study study = openStudy(tiny.protocol, tiny.stimuli);
    const auto run = [&](const DataFolder& folder, const std::string& participant) {
        SimulatedObserver observer(study.protocol, 1, participant);
        return runSession(study, folder, {participant, 1, true}, observer);
    };
    for (int kill = 0; kill < 60; ++kill) {
        const DataFolder folder(temporary.path() / std::to_string(kill), study.protocol);
        const pid_t child = ::fork();
        if (child == 0) {
            for (int i = 1; i <= 9; ++i)
                run(folder, fmt::format("S{}", i));
            ::_exit(0);
        }
        while (bytesIn(folder.path()) < static_cast<std::uintmax_t>(kill) * 500)
            ;
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        if (!fs::exists(folder.path()))
            continue;
        SCOPED_TRACE(kill);
        expectWhole(folder.path());
        if (kill % 6 != 0) // a session takes half a second on a slow disk
            continue;
        EXPECT_TRUE(run(folder, "Next"));
        for (const SlotRecord& record : Ledger(folder.ledger()).records())
            EXPECT_TRUE(record.state == SlotState::completed || isOrphan(record));
    }
}

} // namespace
} // namespace obscura
