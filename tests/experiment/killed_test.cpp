#include "base/files.h"
#include "experiment/recorder.h"
#include "experiment/session.h"
#include "experiment/simulated.h"
#include "protocols/reader/responses.h"
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <new>
#include <random>
#include <set>
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

// What a participant has been through, seen from outside the process that is killed.
struct Seen {
    std::atomic<int> begun = 0;    // trials of which something was shown
    std::atomic<int> finished = 0; // trials after which the next was prepared
};

class Watched : public SimulatedObserver {
  public:
    Watched(const Study& study, Seen& seen)
        : SimulatedObserver(study.protocol, 1, "S1"), phases_(phasesOf(study.protocol.trial)),
          seen_(seen) {}

    void prepare(const Upcoming& trial) override {
        seen_.finished = trial.index - 1;
        index_ = trial.index;
        trials.push_back(trial.planned);
        SimulatedObserver::prepare(trial);
    }
    double show(const TrialMachine& trial) override {
        if (trial.screen() != leaveScreen &&
            !phases_[static_cast<std::size_t>(trial.screen())].images.empty())
            seen_.begun = index_;
        return SimulatedObserver::show(trial);
    }
    std::vector<PlannedTrial> trials;

  private:
    std::vector<Phase> phases_;
    Seen& seen_;
    int index_ = 0;
};

// The lines of a table by the number of the trial.
std::multiset<int> trialsIn(const fs::path& table) {
    std::multiset<int> trials;
    if (fs::exists(table))
        for (const test::Row& row : test::rowsOf(table))
            trials.insert(std::stoi(row.at("trial_index")));
    return trials;
}

// Kills sessions of one study, and goes on with each.
class Killer {
  public:
    explicit Killer(const fs::path& protocol) {
        test::writeNoiseStimuli(readProtocol(protocol), temporary_.path() / "stimuli");
        study_ = openStudy(protocol, temporary_.path() / "stimuli");
        const DataFolder folder = newFolder();
        Seen seen;
        Watched observer(study_, seen);
        EXPECT_TRUE(runSession(study_, folder, session_, observer));
        all_ = observer.trials;
        bytes_ = bytesIn(folder.path());
    }

    // Once the session has written that share of what a whole one writes, and a moment later.
    void kill(double share, int spins) {
        const DataFolder folder = newFolder();
        void* memory = ::mmap(nullptr, sizeof(Seen), PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        Seen& seen = *new (memory) Seen;
        const pid_t child = ::fork();
        if (child == 0) {
            Watched observer(study_, seen);
            runSession(study_, folder, session_, observer);
            ::_exit(0);
        }
        int status = 0;
        pid_t ended = 0;
        while (static_cast<double>(bytesIn(folder.path())) < share * static_cast<double>(bytes_) &&
               (ended = ::waitpid(child, &status, WNOHANG)) == 0)
            ;
        for (volatile int i = 0; i < spins;)
            i = i + 1;
        if (ended == 0) {
            ::kill(child, SIGKILL);
            ::waitpid(child, &status, 0);
        }
        check(folder, seen);
        ::munmap(memory, sizeof(Seen));
        fs::remove_all(folder.path().parent_path());
    }

  private:
    DataFolder newFolder() {
        return {temporary_.path() / fmt::format("data{}", ++folders_), study_.protocol};
    }

    void check(const DataFolder& folder, const Seen& seen) {
        if (!fs::exists(folder.path()))
            return; // it had not yet begun
        EXPECT_THAT(damaged(folder), testing::IsEmpty());
        const bool began = fs::exists(folder.journal(session_));
        EXPECT_TRUE(began || seen.begun == 0);
        if (!began) {
            Seen none;
            Watched next(study_, none);
            EXPECT_TRUE(runSession(study_, folder, {"S2", 1, true}, next));
            return;
        }
        restoreTables(folder, session_);
        EXPECT_EQ(restoreTables(folder, session_), 0);
        if (endOf(folder.journal(session_)) != "completed")
            goOn(folder, seen);
        const auto slots = Ledger(folder.ledger()).records();
        ASSERT_EQ(slots.size(), 1u);
        EXPECT_TRUE(slots[0].state == SlotState::completed || isOrphan(slots[0]));
    }

    // Every trial that was answered is in the tables, each that was shown without an answer is
    // known for half seen, and the others follow.
    void goOn(const DataFolder& folder, const Seen& seen) {
        const BrokenSession broken = brokenSession(study_, folder, session_);
        const auto halfSeen = static_cast<int>(broken.halfSeen.size());
        EXPECT_LE(halfSeen, 1);
        EXPECT_GE(broken.trials, seen.begun);
        EXPECT_GE(broken.trials - halfSeen, seen.finished);
        Seen ignored;
        Watched observer(study_, ignored);
        EXPECT_TRUE(resumeSession(study_, folder, broken, observer));
        std::set<int> finished;
        for (const int trial : trialsIn(folder.phases(session_)))
            if (trial > 0) // pages before and after them are no trials
                finished.insert(trial);
        const int trials = broken.trials + static_cast<int>(observer.trials.size());
        EXPECT_EQ(static_cast<int>(finished.size()), trials - halfSeen);
        if (adaptiveTrials(study_.protocol.ordering) == 0) {
            EXPECT_EQ(observer.trials,
                      std::vector<PlannedTrial>(all_.begin() + broken.trials, all_.end()));
        }
    }

    test::TemporaryFolder temporary_;
    Study study_;
    const SessionId session_{"S1", 1, true};
    std::vector<PlannedTrial> all_; // of a session that nothing disturbs
    std::uintmax_t bytes_ = 0;      // that it writes
    int folders_ = 0;
};

// Killed at sixty different amounts of what it would have written, whatever the method, a session
// leaves whole files, nothing that was answered is lost, and it goes on. OBSCURA_KILLS=1000 for
// more (docs/measurement.md).
TEST(Killed, AtAnyMomentNothingIsLostAndTheSessionGoesOn) {
    const char* asked = std::getenv("OBSCURA_KILLS");
#ifdef OBSCURA_SANITIZED
    constexpr int enough = 20; // each takes thrice as long
#else
    constexpr int enough = 60;
#endif
    const int kills = asked ? std::atoi(asked) : enough;
    const std::vector<fs::path> studies = test::shippedStudies();
    std::mt19937 random(20100); // the moments vary with the machine anyway
    std::uniform_real_distribution<double> share(0, 1);
    std::uniform_int_distribution<int> spins(0, 1000000);
    for (std::size_t study = 0; study < studies.size(); ++study) {
        Killer killer(studies[study]);
        for (std::size_t kill = study; kill < static_cast<std::size_t>(kills);
             kill += studies.size()) {
            SCOPED_TRACE(fmt::format("{}, kill {}", studies[study].string(), kill));
            killer.kill(share(random), spins(random));
        }
    }
}

} // namespace
} // namespace obscura
