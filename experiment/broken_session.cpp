#include "experiment/broken_session.h"

#include "base/error.h"
#include "base/files.h"
#include "experiment/machine.h"
#include "protocols/reader/trial_tables.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>

namespace obscura {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int knownVersion = 3;    // 1 and 2 did not keep what was answered
constexpr int clockTolerance = 60; // seconds by which the clock may have been corrected meanwhile

// One entry of a journal that began with "trial_started": its answers once it was finished.
struct JournalTrial {
    std::string condition;
    std::optional<std::vector<AnswerRow>> answers;
    bool interrupted = false;
};

struct Journal {
    int slot = 0, version = 0;
    std::vector<JournalTrial> trials; // in order; the nth has the number n
    std::set<std::string> pages;      // that were ended
    std::string ended;                // the last reason; "" for none
    std::string time;                 // of the last entry
};

JournalTrial& trialOf(Journal& journal, const json& entry) {
    const int number = entry.at("trial");
    if (number != static_cast<int>(journal.trials.size()))
        throw Error(fmt::format("expected an entry of trial {}, found trial {}",
                                journal.trials.size(), number));
    return journal.trials.back();
}

void add(Journal& journal, const json& entry) {
    const std::string event = entry.at("event");
    journal.time = entry.at("time");
    if (event == "session_started") {
        journal.slot = entry.at("slot");
        journal.version = entry.value("format_version", 1);
    } else if (event == "trial_started") {
        journal.trials.emplace_back();
        trialOf(journal, entry).condition = entry.at("condition");
    } else if (event == "trial_finished") {
        JournalTrial& trial = trialOf(journal, entry);
        trial.answers = answerRowsOf(entry.at("answers"), "answers");
        const std::vector<PhaseRow> phases = phaseRowsOf(entry.at("phases"), "phases");
        trial.interrupted = std::any_of(phases.begin(), phases.end(),
                                        [](const PhaseRow& phase) { return phase.interrupted; });
    } else if (event == "page_finished") {
        journal.pages.insert(
            pageKey(entry.at("pages").get<std::string>(), entry.at("page").get<std::string>()));
    } else if (event == "session_resumed") {
        journal.ended.clear();
    } else if (event == "session_ended") {
        journal.ended = entry.at("reason");
    }
}

// A last line that is not whole was being written when the session broke off.
Journal readJournal(const fs::path& path) {
    Journal journal;
    const std::string text = readFile(path);
    int line = 0;
    for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != text.npos; begin = end + 1) {
        ++line;
        try {
            add(journal, json::parse(text.substr(begin, end - begin)));
        } catch (const std::exception& error) {
            throw Error({path.string(), line, 0, {}},
                        fmt::format("expected an entry as this program writes it ({}); put the "
                                    "original back, or begin another session (--session)",
                                    error.what()));
        }
    }
    return journal;
}

// Seconds since then, by this machine's clock.
double ageOf(const std::string& time, const fs::path& path) {
    std::tm parts{};
    const char* rest = ::strptime(time.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    if (!rest || *rest)
        throw Error({path.string(), 0, 0, "time"},
                    fmt::format("expected a time such as {}, found \"{}\"", utcNow(), time));
    return std::difftime(std::time(nullptr), ::timegm(&parts));
}

void checkAge(double seconds, int minutes, const std::string& time) {
    if (seconds < -clockTolerance)
        throw Error(fmt::format("it broke off at {}, which is later than now ({}): this machine's "
                                "clock was set back; set it right",
                                time, utcNow()));
    if (minutes == 0)
        throw Error(
            "the study lets nobody go on with a session that broke off (resumeMinutes = 0)");
    if (seconds > 60.0 * minutes)
        throw Error(fmt::format("it broke off {:.0f} minutes ago, and the study allows {} "
                                "(resumeMinutes)",
                                std::floor(seconds / 60), minutes));
}

// By name, what an order may depend on: of an answer about images the roles, else the value.
std::map<std::string, std::string> answersIn(const std::vector<AnswerRow>& rows,
                                             const Trial& trial) {
    std::map<std::string, bool> images;
    for (const Phase& phase : phasesOf(trial))
        for (const Question& question : phase.questions)
            images[question.name] = question.images;
    std::map<std::string, std::string> answers;
    for (const AnswerRow& row : rows)
        answers[row.question] = images[row.question] && !row.role.empty() ? row.role : row.value;
    return answers;
}

// The trial that the history leads to, with the breaks before it.
PlannedTrial nextTrial(const Study& study, int slot, std::vector<PastTrial>& history) {
    for (;;) {
        const std::optional<PlannedTrial> trial = next(study.protocol, slot, history);
        if (!trial)
            throw Error("it has more trials than the protocol");
        if (trial->kind != PlannedTrial::Kind::rest)
            return *trial;
        history.push_back({*trial, {}, false});
    }
}

void replay(const Study& study, const Journal& journal, BrokenSession& broken) {
    for (const JournalTrial& one : journal.trials) {
        PastTrial past{nextTrial(study, journal.slot, broken.history), {}, one.interrupted};
        const std::string& expected = study.condition(past.trial.condition).condition;
        if (one.condition != expected)
            throw Error(fmt::format("its trial {} was \"{}\", and the protocol's order has \"{}\" "
                                    "there: the design has changed",
                                    broken.trials + 1, one.condition, expected));
        if (one.answers)
            past.answers = answersIn(*one.answers, study.protocol.trial);
        else
            broken.halfSeen.push_back(one.condition);
        past.interrupted |= !one.answers;
        broken.history.push_back(std::move(past));
        ++broken.trials;
    }
}

void checkCanGoOn(const Study& study, const fs::path& path, const Journal& journal) {
    if (journal.version != knownVersion)
        throw Error(fmt::format("its journal has format_version {}, and going on needs {}",
                                journal.version, knownVersion));
    if (journal.ended == "completed")
        throw Error("it was completed");
    if (journal.ended.starts_with(endedByAnswer))
        throw Error("it was " + journal.ended);
    checkAge(ageOf(journal.time, path), study.protocol.ordering.resumeMinutes, journal.time);
    if (journal.slot < 1 || journal.slot > highestSlot)
        throw Error(fmt::format("its slot is {}", journal.slot));
}

} // namespace

std::string pageKey(std::string_view kind, const std::string& page) {
    return std::string(kind) + "/" + page;
}

std::string endOf(const fs::path& journal) { return readJournal(journal).ended; }

BrokenSession brokenSession(const Study& study, const DataFolder& folder,
                            const SessionId& session) {
    const fs::path path = folder.journal(session);
    const std::string whose = fmt::format("session {} of {}", session.number, session.participant);
    if (!fs::exists(path))
        throw Error(
            fmt::format("{} cannot be gone on with: it has no journal ({})", whose, path.string()));
    const Journal journal = readJournal(path);
    BrokenSession broken{session, journal.slot, {}, 0, {}, journal.pages};
    try {
        checkCanGoOn(study, path, journal);
        replay(study, journal, broken);
    } catch (const Error& error) {
        throw Error({path.string(), 0, 0, {}},
                    fmt::format("{} cannot be gone on with: {}", whose, error.what()));
    }
    return broken;
}

} // namespace obscura
