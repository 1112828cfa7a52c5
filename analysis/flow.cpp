#include "analysis/flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

namespace obscura {

namespace {

using Session = std::pair<std::string, std::string>; // participant and session

std::set<Session> sessionsOf(const std::vector<Answer>& rows) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    std::set<Session> sessions;
    for (const Answer& answer : rows)
        if (seen.emplace(answer.row.participantId.number(), answer.row.sessionId.number()).second)
            sessions.emplace(answer.row.participantId.text(), answer.row.sessionId.text());
    return sessions;
}

// Reasons of one rule differ in their numbers: "3 of 8 catch trials" is "… of … catch trials".
std::string withoutNumbers(const std::string& reason) {
    const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    std::string text;
    for (std::size_t i = 0; i < reason.size(); ++i)
        if (!isDigit(reason[i]))
            text += reason[i];
        else if (i == 0 || !isDigit(reason[i - 1]))
            text += "…";
    return text;
}

std::vector<Flow::Loss> lossesOf(const std::map<std::string, int>& counts) {
    std::vector<Flow::Loss> losses;
    for (const auto& [reason, count] : counts)
        if (count > 0)
            losses.push_back({reason, count});
    return losses;
}

// Sessions that took a place in the ledger and of which there is no answer.
void addUnanswered(const Answers& answers, const std::set<Session>& answered, Flow& flow) {
    if (answers.slots.empty() || answers.counted.empty())
        return;
    const bool simulated = answers.counted.front().row.simulated;
    std::map<Session, SlotState> begun;
    for (const SlotRecord& record : answers.slots)
        if (record.session.simulated == simulated)
            begun[{record.session.participant, fmt::format("{}", record.session.number)}] =
                record.state;
    std::map<std::string, int> reasons;
    for (const auto& [session, state] : begun)
        if (!answered.contains(session))
            ++reasons[state == SlotState::returned   ? "voided before any answer"
                      : state == SlotState::reserved ? "begun, no answer yet"
                                                     : "completed, but not among these answers"];
    flow.begun = static_cast<int>(begun.size());
    flow.unanswered = lossesOf(reasons);
}

} // namespace

int Flow::sum(const std::vector<Loss>& losses) {
    int total = 0;
    for (const Loss& loss : losses)
        total += loss.count;
    return total;
}

Flow flowOf(const Answers& answers, int participants, int sessions) {
    Flow flow;
    flow.participants = participants;
    flow.sessions = sessions;
    flow.trials = static_cast<int>(answers.counted.size());
    const std::set<Session> counted = sessionsOf(answers.counted);
    std::set<Session> answered = sessionsOf(answers.excluded.rows);
    answered.insert(counted.begin(), counted.end());
    addUnanswered(answers, answered, flow);

    std::map<std::string, int> excluded, trials;
    std::set<Session> gone; // each for its first reason
    for (const Exclusion& one : answers.excluded.reasons) {
        const Session session{one.participant, one.session};
        const bool isWhole = !one.participant.empty() && !counted.contains(session);
        if (!isWhole)
            trials[withoutNumbers(one.reason)] += one.trials;
        else if (gone.insert(session).second)
            ++excluded[withoutNumbers(one.reason)];
    }
    const LeftOut& out = answers.leftOut;
    trials["interrupted: the window lost the keyboard"] += out.interrupted;
    trials["answered twice"] += out.duplicates;
    trials["simulated"] += out.simulated;
    trials["not simulated"] += out.real;
    trials["rehearsed"] += out.rehearsed;
    trials["unreadable"] += static_cast<int>(answers.bad.size());
    flow.excluded = lossesOf(excluded);
    flow.leftOut = lossesOf(trials);
    return flow;
}

} // namespace obscura
