#include "experiment/row.h"

#include "base/csv.h"
#include "base/version.h"
#include "experiment/machine.h"
#include "protocols/reader/trial_tables.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace obscura {

namespace {

std::string settings(const Recipe& recipe) { return nlohmann::json(recipe.settings).dump(); }

Response identity(const Context& context, const Upcoming& trial) {
    const PlannedTrial& planned = trial.planned;
    Response row;
    row.rowId =
        fmt::format("{}-{}-{}", context.session.participant, context.session.number, trial.index);
    row.studyId = context.study.protocol.name;
    row.participantId = context.session.participant;
    row.sessionId = fmt::format("{}", context.session.number);
    row.simulated = context.session.simulated;
    row.rehearsal = context.session.rehearsal;
    row.designSha256 = context.designSha256;
    row.slotId = context.assignment.slot;
    row.squareId = context.assignment.square;
    row.squareRow = context.assignment.row;
    row.pairsReversed = context.assignment.exchange != 0;
    row.trialIndex = trial.index;
    row.trialKind = nameOf(planned.kind);
    row.repeatIndex = planned.repeat;
    return row;
}

void addCondition(Response& row, const ConditionRecord& condition, const Upcoming& trial) {
    const ImageRecord &a = condition.image("a"), &b = condition.image("b"),
                      &first = condition.image(trial.role("1")),
                      &second = condition.image(trial.role("2"));
    row.conditionId = condition.condition;
    row.level = condition.level;
    row.scene = condition.view;
    row.hypothesis = condition.hypothesis;
    row.techniqueA = a.name;
    row.techniqueB = b.name;
    row.paramsA = settings(a.recipe);
    row.paramsB = settings(b.recipe);
    row.stimFirst = first.image.path;
    row.stimSecond = second.image.path;
    row.sha256First = first.image.sha256;
    row.sha256Second = second.image.sha256;
    row.firstIs = first.role;
}

void addTiming(Response& row, const TrialRecord& trial, const PairPhases& pair,
               const Refresh& refresh) {
    const PhaseRecord &first = trial.phases[pair.first], &mask = trial.phases[pair.mask],
                      &second = trial.phases[pair.second], &question = trial.phases[pair.question];
    row.onset1Ms = 1000 * first.onset;
    row.view1Ms = 1000 * first.view;
    row.maskFramesPlanned = mask.framesPlanned;
    row.maskFramesShown = mask.framesShown;
    row.maskMs = 1000 * mask.view;
    row.onset2Ms = 1000 * second.onset;
    row.view2Ms = 1000 * second.view;
    row.questionOnsetMs = 1000 * question.onset;
    row.decisionRtMs = 1000 * trial.answers[pair.answer].seconds;
    row.refreshHz = refresh.hz;
    row.missedFrames = mask.missedFrames;
    row.timestampSource = refresh.source;
    row.earlyPressesInMask = mask.earlyPresses;
}

void addAnswer(Response& row, const TrialRecord& trial, const PairPhases& pair) {
    row.chosenPosition = trial.answers[pair.answer].value == "2" ? 2 : 1;
    row.choseB = (row.chosenPosition == 2) == (row.firstIs == "a");
    row.chosenTechnique = row.choseB ? row.techniqueB : row.techniqueA;
    row.interrupted = trial.interrupted;
}

void addProvenance(Response& row, const Protocol& protocol) {
    row.appVersion = version();
    row.gitCommit = commit();
    row.protocolSha256 = protocol.sha256;
    row.machineId = machineName();
    row.wallTimeUtc = utcNow();
}

} // namespace

std::optional<PairPhases> pairPhasesOf(const Trial& trial) {
    if (trial.order != Trial().order)
        return std::nullopt;
    const std::vector<Phase> phases = phasesOf(trial);
    PairPhases pair;
    const auto shows = [&](std::size_t i, const char* image) {
        return i < phases.size() && phases[i].images == std::vector<std::string>{image} &&
               phases[i].questions.empty();
    };
    while (pair.first < phases.size() && !shows(pair.first, "1"))
        ++pair.first;
    pair.mask = pair.first + 1;
    pair.second = pair.first + 2;
    if (!shows(pair.second, "2") || phases[pair.mask].grey < 0 || !phases[pair.mask].locked())
        return std::nullopt;
    for (pair.question = 0; pair.question < phases.size(); ++pair.question)
        for (const Question& question : phases[pair.question].questions) {
            if (question.images && question.options.size() == 2 && question.unsure.empty() &&
                !question.optional && !phases[pair.question].counted())
                return pair;
            ++pair.answer;
        }
    return std::nullopt;
}

Response makeRow(const Context& context, const Upcoming& trial, const TrialRecord& record,
                 const PairPhases& pair) {
    Response row = identity(context, trial);
    addCondition(row, context.study.condition(trial.planned.condition), trial);
    addTiming(row, record, pair, context.refresh);
    addAnswer(row, record, pair);
    addProvenance(row, context.study.protocol);
    return row;
}

namespace {

std::string joined(const std::vector<std::string>& words, const char* separator) {
    return fmt::format("{}", fmt::join(words, separator));
}

TrialKey keyOf(const Context& context, std::string_view trial, const std::string& part) {
    TrialKey key;
    key.rowId = fmt::format("{}-{}-{}-{}", context.session.participant, context.session.number,
                            trial, part);
    key.studyId = context.study.protocol.name;
    key.participantId = context.session.participant;
    key.sessionId = fmt::format("{}", context.session.number);
    key.simulated = context.session.simulated;
    key.rehearsal = context.session.rehearsal;
    key.slotId = context.assignment.slot;
    return key;
}

TrialKey keyOf(const Context& context, const Upcoming& trial, const std::string& part) {
    const ConditionRecord& condition = context.study.condition(trial.planned.condition);
    TrialKey key = keyOf(context, fmt::format("{}", trial.index), part);
    key.trialIndex = trial.index;
    key.trialKind = nameOf(trial.planned.kind);
    key.repeatIndex = trial.planned.repeat;
    key.block = trial.planned.block;
    key.conditionId = condition.condition;
    key.level = condition.level;
    key.scene = condition.view;
    key.hypothesis = condition.hypothesis;
    key.roles = joined(trial.order, ">");
    std::vector<std::string> techniques;
    for (const std::string& role : trial.order)
        techniques.push_back(condition.image(role).name);
    key.techniques = joined(techniques, ">");
    return key;
}

// But for the trial and its images.
PhaseRow phaseRow(const Context& context, const Phase& phase, const PhaseRecord& record,
                  int index) {
    PhaseRow row;
    row.phaseIndex = index;
    row.phase = phase.name;
    row.onsetMs = 1000 * record.onset;
    row.viewMs = 1000 * record.view;
    row.framesPlanned = record.framesPlanned;
    row.framesShown = record.framesShown;
    row.missedFrames = record.missedFrames;
    row.earlyPresses = record.earlyPresses;
    row.hastyPresses = record.hastyPresses;
    row.interrupted = record.interrupted;
    row.timedOut = record.timedOut;
    row.refreshHz = context.refresh.hz;
    row.timestampSource = context.refresh.source;
    return row;
}

PhaseRow phaseRow(const Context& context, const Upcoming& trial, const Phase& phase,
                  const PhaseRecord& record, int index) {
    PhaseRow row = phaseRow(context, phase, record, index);
    row.trial = keyOf(context, trial, phase.name);
    std::vector<std::string> roles, files, hashes;
    for (const std::string& image : phase.images) {
        const ImageRecord& shown =
            context.study.condition(trial.planned.condition).image(trial.role(image));
        roles.push_back(shown.role);
        files.push_back(shown.image.path);
        hashes.push_back(shown.image.sha256);
    }
    row.images = joined(roles, "+");
    row.files = joined(files, "+");
    row.sha256 = joined(hashes, "+");
    return row;
}

AnswerRow answerRow(const Context& context, const TrialKey& key, const Phase& phase,
                    const Question& question, const FormAnswer& answer) {
    AnswerRow row;
    row.trial = key;
    row.phase = phase.name;
    row.question = question.name;
    row.kind = nameOf(question.kind);
    row.value = answer.value;
    row.responseMs = 1000 * answer.seconds;
    row.appVersion = version();
    row.gitCommit = commit();
    row.protocolSha256 = context.study.protocol.sha256;
    row.designSha256 = context.designSha256;
    row.machineId = machineName();
    row.wallTimeUtc = utcNow();
    return row;
}

} // namespace

std::string rolesIn(const Question& question, const std::string& value,
                    const std::vector<std::string>& order) {
    const bool ranks = question.kind == Question::Kind::rank;
    if (!ranks && !question.images)
        return {};
    std::vector<std::string> roles;
    for (std::size_t begin = 0; begin < value.size();) {
        const std::size_t end = std::min(value.find('>', begin), value.size());
        int place = 0;
        if (readCell(value.substr(begin, end - begin), place) && place >= 1 &&
            place <= static_cast<int>(order.size()))
            roles.push_back(order[static_cast<std::size_t>(place - 1)]);
        begin = end + 1;
    }
    return joined(roles, ">");
}

TrialLines linesOf(const Context& context, const Upcoming& trial, const TrialRecord& record) {
    const Trial& shape = context.study.protocol.trial;
    const std::vector<Phase> phases = phasesOf(shape);
    TrialLines lines;
    if (const auto pair = pairPhasesOf(shape))
        lines.rows = responseLine(makeRow(context, trial, record, *pair));
    std::size_t answered = 0;
    for (std::size_t i = 0; i < phases.size(); ++i) {
        lines.phases += phaseLine(
            phaseRow(context, trial, phases[i], record.phases[i], static_cast<int>(i) + 1));
        for (const Question& question : phases[i].questions) {
            AnswerRow row = answerRow(context, keyOf(context, trial, question.name), phases[i],
                                      question, record.answers[answered++]);
            row.role = rolesIn(question, row.value, trial.order);
            row.interrupted = record.interrupted;
            lines.answers += answerLine(row);
        }
    }
    return lines;
}

TrialLines linesOf(const Context& context, std::string_view kind, const Phase& page,
                   const TrialRecord& record) {
    TrialLines lines;
    PhaseRow row = phaseRow(context, page, record.phases.front(), 1);
    row.trial = keyOf(context, kind, page.name);
    row.trial.trialKind = kind;
    lines.phases = phaseLine(row);
    for (std::size_t i = 0; i < page.questions.size(); ++i)
        lines.answers += answerLineOf(context, kind, page, record, i);
    return lines;
}

std::string answerLineOf(const Context& context, std::string_view kind, const Phase& page,
                         const TrialRecord& record, std::size_t question) {
    const Question& asked = page.questions[question];
    TrialKey key = keyOf(context, kind, asked.name);
    key.trialKind = kind;
    return answerLine(answerRow(context, key, page, asked, record.answers[question]));
}

} // namespace obscura
