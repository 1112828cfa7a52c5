#include "base/arguments.h"
#include "base/error.h"
#include "base/files.h"
#include "base/program.h"
#include "base/progress.h"
#include "experiment/broken_session.h"
#include "experiment/calibrate.h"
#include "experiment/card.h"
#include "experiment/check.h"
#include "experiment/command_line.h"
#include "experiment/continuity.h"
#include "experiment/data_folder.h"
#include "experiment/language.h"
#include "experiment/ledger.h"
#include "experiment/ledger_command.h"
#include "experiment/presenter.h"
#include "experiment/preview.h"
#include "experiment/recorder.h"
#include "experiment/screen_file.h"
#include "experiment/session.h"
#include "experiment/signals.h"
#include "experiment/simulated.h"
#include "experiment/start_facts.h"
#include "experiment/timing_command.h"
#include "experiment/visual.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

namespace obscura {

namespace fs = std::filesystem;

namespace {

int listMonitors() {
    int number = 0;
    for (const gl::Monitor& monitor : gl::monitors())
        fmt::print("{}  {}  {}x{} at {} Hz, {}x{} mm\n", ++number, monitor.name, monitor.width,
                   monitor.height, monitor.refreshHz, monitor.widthMm, monitor.heightMm);
    return 0;
}

void checkFolder(const DataFolder& folder, const Study& study) {
    if (const std::string unknown = checkContinues(folder, study); !unknown.empty())
        fmt::print(stderr, "obscura-experiment: {}\n", unknown);
}

gl::WindowOptions::Size sizeOf(const std::string& option, const std::string& text) {
    const auto size = parsePair(text, 'x');
    if (!size || std::max(size->first, size->second) > 16384)
        throw Error(
            fmt::format("{}: expected a size such as 1280x800, found \"{}\"", option, text));
    return {size->first, size->second};
}

gl::WindowOptions windowOptions(const Arguments& arguments) {
    gl::WindowOptions options{"Obscura", arguments.monitor, std::nullopt, throwIfEnded};
    if (arguments.windowed)
        options.windowed = arguments.windowSize.empty()
                               ? gl::WindowOptions::Size{1280, 800}
                               : sizeOf("--windowed", arguments.windowSize);
    return options;
}

DisplayOptions displayOptions(const Arguments& arguments, const Study& study) {
    return {windowOptions(arguments), study.protocol.trial.grey, arguments.photodiode,
            arguments.trigger};
}

int simulate(const Arguments& arguments, const Study& study) {
    if (!arguments.trigger.empty() && !arguments.visual)
        throw Error("--trigger: without a window nothing comes on; give --visual too");
    verifyStimuli(study.manifest);
    const Protocol& protocol = study.protocol;
    const DataFolder folder(arguments.data, protocol);
    checkFolder(folder, study);
    const int count = arguments.simulated ? arguments.simulated : protocol.ordering.participants;
    std::optional<StimulusDisplay> display;
    std::optional<Presenter> presenter;
    if (arguments.visual) {
        display.emplace(displayOptions(arguments, study), curtain(study));
        presenter.emplace(*display, study, "Simulated participant: answers do not count");
    }
    const Manifest* const seen = arguments.observer == "jod" ? &study.manifest : nullptr;
    Progress progress("simulated participants", count);
    for (int i = 1; i <= count; ++i) {
        const SessionId session{fmt::format("S{:02}", i), arguments.session, true};
        if (const std::string problem = objection(folder, session); !problem.empty())
            throw Error(problem + "; or another data folder: --data DIR");
        const std::uint64_t seed = arguments.seed.value_or(protocol.seed);
        if (presenter) {
            VisualObserver observer(*presenter, protocol, seed, session.participant, seen);
            runSession(study, folder, session, observer);
        } else {
            SimulatedObserver observer(protocol, seed, session.participant, seen);
            runSession(study, folder, session, observer);
        }
        progress.update(i, session.participant);
    }
    return 0;
}

// Which text stands above every page, and on stderr: the session is no measurement; or none. An
// Error on a display that no data should be collected on.
std::string Texts::*warning(const Arguments& arguments, const StimulusDisplay& display) {
    fmt::print(stderr, "obscura-experiment: the display: {}\n", display.inWords());
    const Refresh& refresh = display.refresh();
    const std::string objection = display.objection();
    if (!objection.empty() && !arguments.rehearse && !arguments.allowUntimed)
        throw Error(objection + "; or go on with --allow-untimed: every row then says "
                                "timestamp_source none");
    if (refresh.source == "none") {
        fmt::print(stderr,
                   "obscura-experiment: {}: rows are marked timestamp_source none: not "
                   "suitable for data collection.\n",
                   objection.empty() ? fmt::format("no vertical blank to go by ({}). Pictures are "
                                                   "paced by the clock at 60 Hz",
                                                   refresh.doubt)
                                     : objection);
        if (!arguments.allowUntimed)
            return &Texts::untimed;
    }
    return arguments.rehearse ? &Texts::rehearsal : nullptr;
}

// Of sessions whose process has died: what their journals have is written into their tables, one
// that had come to its end keeps its slot, and the experimenter is told of the others.
void mendOrphans(const DataFolder& folder) {
    Ledger ledger(folder.ledger());
    for (const SlotRecord& record : ledger.records()) {
        if (!isOrphan(record))
            continue;
        if (fs::exists(folder.journal(record.session))) {
            restoreTables(folder, record.session);
            if (endOf(folder.journal(record.session)) == "completed") {
                SlotClaim(ledger, record.slot, record.session, record.design).complete();
                continue;
            }
        }
        fmt::print(
            stderr,
            "obscura-experiment: session {1} of {0} broke off; what was answered is kept. Go "
            "on with it by --participant {0} --session {1} --resume, or give its slot back: "
            "obscura-experiment ledger --void {2}\n",
            record.session.participant, record.session.number, record.slot);
    }
}

// What a participant who gives this id would do.
IdVerdict judge(const Study& study, const DataFolder& folder, const SessionId& session) {
    if (objection(folder, session).empty())
        return {true};
    try {
        if (!session.rehearsal && isParticipantId(session.participant))
            return {true, brokenSession(study, folder, session).trials};
    } catch (const Error& error) {
        fmt::print(stderr, "obscura-experiment: {}\n", error.what());
    }
    return {};
}

// An Error when a session cannot be run, or not be gone on with, under the id that was given.
void checkParticipant(const Arguments& arguments, const Study& study, const DataFolder& folder,
                      const SessionId& session) {
    if (arguments.resume) {
        brokenSession(study, folder, session);
        return;
    }
    std::string problem = objection(folder, session);
    if (problem.empty())
        return;
    if (judge(study, folder, session).broken)
        problem = fmt::format("session {} broke off; --resume goes on with it", session.number);
    throw Error(fmt::format("--participant {}: {}", arguments.participant, problem));
}

SessionId sessionOf(const Arguments& arguments, const DataFolder& folder, const std::string& id) {
    SessionId session{id, arguments.session, false, arguments.rehearse};
    while (session.rehearsal && fs::exists(folder.journal(session)))
        ++session.number; // people rehearse more than once
    return session;
}

// Says how the images are seen. An Error where that is not as the study wants it.
Viewing viewingOn(const Arguments& arguments, const Study& study, const gl::Monitor& monitor) {
    const Manifest& images = study.manifest;
    Viewing viewing{study.protocol.screen, {}, images.width, images.height};
    viewing.size = arguments.screenMm.empty()
                       ? cardSize(arguments.data, monitor)
                       : screenSizeOf(arguments.screenMm, monitor.width, monitor.height);
    if (const std::string words = inWords(viewing); !words.empty())
        fmt::print(stderr, "obscura-experiment: viewing: {}\n", words);
    if (const std::string wrong = objectionTo(viewing); !wrong.empty()) {
        if (!arguments.rehearse)
            throw Error(wrong + " (images are never scaled)");
        fmt::print(stderr, "obscura-experiment: no session but a rehearsal: {}\n", wrong);
    }
    return viewing;
}

// Nothing when the experimenter wants another monitor.
std::optional<int> presentOn(const Arguments& arguments, Study& study, const DataFolder& folder,
                             int monitors) {
    StimulusDisplay display(displayOptions(arguments, study), curtain(study));
    const Viewing viewing = viewingOn(arguments, study, display.monitor());
    std::string Texts::*const above = warning(arguments, display);
    const bool knows = arguments.resume && !arguments.participant.empty();
    if (!settleLanguage(study, display, above ? study.protocol.texts.*above : "",
                        knows ? folder.sidecar(sessionOf(arguments, folder, arguments.participant))
                              : ""))
        return 0;
    Presenter presenter(display, study, above ? study.texts().*above : "");
    presenter.seenAs(viewing, calibrationOf(arguments.data, display.monitor()));
    Presenter::Start start{arguments.participant};
    if (arguments.participant.empty())
        start =
            presenter.askId(startFacts(study, folder, arguments.rehearse, display, viewing,
                                       arguments.monitor, monitors),
                            [&](const std::string& typed) {
                                return judge(study, folder, sessionOf(arguments, folder, typed));
                            });
    if (start.otherMonitor)
        return std::nullopt;
    if (!start.id)
        return 0;
    const SessionId session = sessionOf(arguments, folder, *start.id);
    const bool completed =
        objection(folder, session).empty()
            ? runSession(study, folder, session, presenter)
            : resumeSession(study, folder, brokenSession(study, folder, session), presenter);
    fmt::print("{}: {}\n", folder.rows(session).string(),
               completed            ? "complete"
               : arguments.rehearse ? "ended before the last trial"
                                    : "ended before the last trial; its slot has been given back");
    return 0;
}

int present(Arguments arguments, Study& study) {
    const DataFolder folder(arguments.data, study.protocol, arguments.rehearse);
    if (arguments.rehearse) {
        fmt::print(stderr,
                   "obscura-experiment: a rehearsal: it takes no slot, and does not count\n");
    } else {
        checkFolder(folder, study);
        mendOrphans(folder);
    }
    if (!arguments.participant.empty())
        checkParticipant(arguments, study, folder,
                         sessionOf(arguments, folder, arguments.participant));
    for (const int monitors = static_cast<int>(gl::monitors().size());;
         arguments.monitor = arguments.monitor % monitors + 1)
        if (const std::optional<int> status = presentOn(arguments, study, folder, monitors))
            return *status;
}

int check(const Arguments& arguments) {
    const auto [width, height] = sizeOf("--size", arguments.size);
    std::string found = checkRuns(readProtocol(arguments.protocol), width, height);
    if (!arguments.stimuli.empty()) {
        const Study study = openStudy(arguments.protocol, arguments.stimuli);
        verifyStimuli(study.manifest);
        found += fmt::format("; {} images are as made", imageCount(study.protocol));
    }
    fmt::print("{}\n", found);
    return 0;
}

int preview(const Arguments& arguments, const Study& study) {
    const auto [width, height] = sizeOf("--size", arguments.size);
    writePng(arguments.preview, previewSheet(study, width, height));
    return 0;
}

int timing(const Arguments& arguments) {
    return holdAndReport({windowOptions(arguments), 128, arguments.photodiode, arguments.trigger},
                         arguments.timing);
}

int run(CLI::App& app, int argc, char** argv) {
    Arguments arguments;
    declare(app, arguments);
    app.parse(argc, argv);
    arguments.simulate = app.count("--simulate") > 0;
    for (const CLI::App* each : {&app, app.get_subcommand("timing"), app.get_subcommand("card"),
                                 app.get_subcommand("calibrate")})
        arguments.windowed |= each->count("--windowed") > 0;
    arguments.rehearse |= arguments.windowed;

    if (arguments.listMonitors)
        return listMonitors();
    if (app.got_subcommand("ledger"))
        return editLedger(arguments.ledger);
    heedSignals();
    const bool times = app.got_subcommand("timing"),
               measures = app.got_subcommand("card") || app.got_subcommand("calibrate");
    if (!times && !measures &&
        (arguments.protocol.empty() || (arguments.stimuli.empty() && !arguments.check)))
        throw Error("expected --protocol FILE and --stimuli DIR; --help explains");
    try {
        if (times)
            return timing(arguments);
        if (measures)
            return (app.got_subcommand("card") ? measureCard : calibrate)(windowOptions(arguments),
                                                                          arguments.data)
                       ? 0
                       : 1;
        if (arguments.check)
            return check(arguments);
        Study study = openStudy(arguments.protocol, arguments.stimuli);
        if (!arguments.language.empty())
            study.language = languageNamed(study.protocol, arguments.language);
        if (!arguments.preview.empty())
            return preview(arguments, study);
        return arguments.simulate ? simulate(arguments, study) : present(arguments, study);
    } catch (const EndedBySignal& ended) {
        fmt::print(stderr, "obscura-experiment: ended by {}; answers so far are kept\n",
                   ended.name());
        return ended.exitStatus();
    }
}

} // namespace

} // namespace obscura

int main(int argc, char** argv) {
    return obscura::runProgram(
        "obscura-experiment",
        "shows a study to one participant and records the answers; simulates participants",
        obscura::run, argc, argv);
}
