#include "experiment/recorder.h"

#include "base/error.h"
#include "base/files.h"
#include "experiment/machine.h"
#include "protocols/reader/trial_tables.h"

#include <nlohmann/json.hpp>

namespace obscura {

using nlohmann::ordered_json;

namespace {

std::string entry(std::string_view event, const ordered_json& details) {
    ordered_json json = {{"event", event}, {"time", utcNow()}};
    json.update(details);
    return json.dump() + "\n";
}

} // namespace

Recorder::Recorder(const DataFolder& folder, const SessionId& session, int slot, bool pairs)
    : rows_(pairs ? std::optional(AppendFile::create(folder.rows(session), responseHeader()))
                  : std::nullopt),
      phases_(AppendFile::create(folder.phases(session), phaseHeader())),
      answers_(AppendFile::create(folder.answers(session), answerHeader())),
      journal_(AppendFile::create(folder.journal(session),
                                  entry("session_started", {{"format_version", 3},
                                                            {"participant", session.participant},
                                                            {"session", session.number},
                                                            {"simulated", session.simulated},
                                                            {"rehearsal", session.rehearsal},
                                                            {"slot", slot}}))) {}

Recorder::Recorder(std::optional<AppendFile> rows, AppendFile phases, AppendFile answers,
                   AppendFile journal)
    : rows_(std::move(rows)), phases_(std::move(phases)), answers_(std::move(answers)),
      journal_(std::move(journal)) {}

Recorder Recorder::resume(const DataFolder& folder, const BrokenSession& broken, bool pairs) {
    const SessionId& session = broken.session;
    restoreTables(folder, session);
    Recorder recorder(pairs ? std::optional(AppendFile::openLocked(folder.rows(session)))
                            : std::nullopt,
                      AppendFile::openLocked(folder.phases(session)),
                      AppendFile::openLocked(folder.answers(session)),
                      AppendFile::openLocked(folder.journal(session)));
    recorder.journal_.append(
        entry("session_resumed", {{"trials", broken.trials}, {"half_seen", broken.halfSeen}}));
    return recorder;
}

void Recorder::trialStarted(int trial, const std::string& condition) {
    journal_.append(entry("trial_started", {{"trial", trial}, {"condition", condition}}));
}

void Recorder::finished(int trial, const TrialLines& lines) {
    keep("trial_finished", {{"trial", trial}}, lines);
}

void Recorder::pageFinished(std::string_view kind, const std::string& page,
                            const TrialLines& lines) {
    keep("page_finished", {{"pages", kind}, {"page", page}}, lines);
}

void Recorder::keep(std::string_view event, ordered_json details, const TrialLines& lines) {
    details.update({{"rows", lines.rows}, {"phases", lines.phases}, {"answers", lines.answers}});
    journal_.append(entry(event, details));
    if (rows_ && !lines.rows.empty())
        rows_->append(lines.rows);
    if (!lines.phases.empty())
        phases_.append(lines.phases);
    if (!lines.answers.empty())
        answers_.append(lines.answers);
}

void Recorder::hastyPresses(int trial, int count) {
    journal_.append(entry("presses_ignored", {{"trial", trial}, {"count", count}}));
}

void Recorder::end(std::string_view reason) {
    journal_.append(entry("session_ended", {{"reason", reason}}));
}

namespace {

// What the journal has of one table, in order.
std::string journalled(const std::string& journal, const char* table) {
    std::string lines;
    for (std::size_t begin = 0, end; (end = journal.find('\n', begin)) != journal.npos;
         begin = end + 1) {
        const auto object =
            nlohmann::json::parse(journal.substr(begin, end - begin), nullptr, false);
        if (object.is_object() && (object.value("event", "") == "trial_finished" ||
                                   object.value("event", "") == "page_finished"))
            lines += object.value(table, "");
    }
    return lines;
}

bool restore(const std::filesystem::path& path, const std::string& header,
             const std::string& lines) {
    if (lines.empty())
        return false;
    if (!std::filesystem::exists(path))
        AppendFile::create(path, header);
    AppendFile file = AppendFile::openLocked(path); // which takes out a last line that was cut
    const std::string content = readFile(path), whole = header + lines;
    if (content.starts_with(whole))
        return false;
    if (!whole.starts_with(content))
        throw Error({path.string(), 0, 0, {}},
                    "expected the lines that the session's journal has, found others; put the "
                    "original back");
    file.append(whole.substr(content.size()));
    return true;
}

} // namespace

int restoreTables(const DataFolder& folder, const SessionId& session) {
    const std::string journal = readFile(folder.journal(session));
    return restore(folder.rows(session), responseHeader(), journalled(journal, "rows")) +
           restore(folder.phases(session), phaseHeader(), journalled(journal, "phases")) +
           restore(folder.answers(session), answerHeader(), journalled(journal, "answers"));
}

} // namespace obscura
