#include "base/files.h"
#include "experiment/recorder.h"
#include "experiment/session.h"
#include "experiment/simulated.h"
#include "protocols/reader/responses.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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

bool isJsonLines(const std::string& text) {
    std::istringstream lines(text);
    bool well = true;
    for (std::string line; std::getline(lines, line);)
        well = well && nlohmann::json::accept(line);
    return well;
}

bool isWhole(const fs::path& path) {
    const std::string name = path.filename().string();
    if (name == "ledger.jsonl" || name.starts_with('.') || name.ends_with(".md"))
        return true; // the first is read below; what is hidden was not finished, and nobody reads
                     // it
    if (name.ends_with(".jsonl"))
        return !readFile(path).empty() && isJsonLines(readFile(path));
    if (name.ends_with(".json"))
        return nlohmann::json::accept(readFile(path));
    if (name.ends_with("_data.csv"))
        readResponses(path, false); // throws
    return true;
}

std::vector<std::string> damaged(const DataFolder& folder) {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path()))
        if (entry.is_regular_file() && !isWhole(entry.path()))
            names.push_back(entry.path().string());
    return names;
}

std::size_t finishedIn(const std::string& journal) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = journal.find("\"trial_finished\"", at)) != journal.npos; ++at)
        ++count;
    return count;
}

// What a participant had answered is in the tables once they have been restored, nothing twice.
void expectNothingLost(const DataFolder& folder) {
    for (int i = 1; i <= 9; ++i) {
        const SessionId session{fmt::format("S{}", i), 1, true};
        if (!fs::exists(folder.journal(session)))
            continue;
        restoreTables(folder, session);
        const std::size_t finished = finishedIn(readFile(folder.journal(session)));
        const auto rows = fs::exists(folder.rows(session))
                              ? readResponses(folder.rows(session), false).rows.size()
                              : 0;
        EXPECT_EQ(rows, finished);
        EXPECT_EQ(restoreTables(folder, session), 0);
    }
}

bool isCompletedOrOrphan(const SlotRecord& record) {
    return record.state == SlotState::completed || isOrphan(record);
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
        while (bytesIn(folder.path()) < static_cast<std::uintmax_t>(kill) * 1500)
            ;
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        if (!fs::exists(folder.path()))
            continue;
        SCOPED_TRACE(kill);
        EXPECT_THAT(damaged(folder), testing::IsEmpty());
        expectNothingLost(folder);
        if (kill % 6 == 0) { // a session takes half a second on a slow disk
            EXPECT_TRUE(run(folder, "Next"));
        }
        const auto slots = Ledger(folder.ledger()).records();
        EXPECT_TRUE(std::all_of(slots.begin(), slots.end(), isCompletedOrOrphan));
    }
}

} // namespace
} // namespace obscura
