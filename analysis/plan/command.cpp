#include "analysis/plan/command.h"

#include "analysis/plan/power_curves.h"
#include "analysis/plan/preregistration.h"
#include "base/files.h"
#include "base/progress.h"
#include "protocols/reader/protocol_argument.h"
#include "protocols/reader/stimuli.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <optional>

namespace obscura {

CLI::App* declarePlan(CLI::App& app, PlanCommand& command) {
    CLI::App* plan = app.add_subcommand(
        "plan", "Before a study: what it can find, how many people it takes, a preregistration");
    PlanOptions& options = command.options;
    takesProtocol(plan->add_option("PROTOCOL", command.protocol, "The study's protocol"))
        ->required()
        ->option_text(" ");
    plan->add_option("--participants", options.participants,
                     "People who finish; without it, as many as the protocol plans")
        ->option_text("N")
        ->check(CLI::Range(1, 10000));
    plan->add_option("--power", options.power, "The probability wanted of finding what is there")
        ->option_text("P=0.8")
        ->check(CLI::Range(0.5, 0.99));
    plan->add_option("--dropout", options.dropout, "Share of the invited who do not finish")
        ->option_text("SHARE=0.1")
        ->check(CLI::Range(0.0, 0.9));
    plan->add_option("--spread", options.spread,
                     "How far people differ: standard deviation of their preference, in JOD; where "
                     "claims are simulated. Assumed, not measured: try several")
        ->option_text("JOD=1")
        ->check(CLI::Range(0.0, 10.0));
    plan->add_option("--studies", options.studies, "Simulated studies for each number")
        ->option_text("N=2000")
        ->check(CLI::Range(100, 1000000));
    plan->add_option("--seed", options.seed, "Of the simulated studies")->option_text("N=1");
    plan->add_option("--observer", command.observer,
                     "By what people are expected to choose: preference (the protocol's "
                     "simulatedPreference), or jod (each image's predicted JOD; --stimuli)")
        ->option_text("WHAT=preference")
        ->check(CLI::IsMember({"preference", "jod"}));
    plan->add_option("--stimuli", command.stimuli,
                     "With --observer jod: the folder that obscura-stimuli wrote for the protocol")
        ->option_text("DIR");
    plan->add_option("--out", command.out, "Folder for preregistration.md and power.svg")
        ->option_text("DIR=plan");
    return plan;
}

void planStudy(const PlanCommand& command) {
    const Protocol protocol = readProtocol(command.protocol);
    const bool sees = command.observer == "jod";
    if (sees == command.stimuli.empty())
        throw Error(sees ? "--observer jod: expected the stimuli whose predicted JOD people go by; "
                           "give --stimuli DIR"
                         : "--stimuli: only --observer jod looks at stimuli; give that too");
    std::optional<Manifest> stimuli;
    if (sees)
        stimuli = readStimuli(protocol, command.stimuli);
    Progress progress("simulated studies", 1);
    const Plan plan = planOf(
        protocol, command.options, [&](double done) { progress.update(done); },
        stimuli ? &*stimuli : nullptr);
    const std::string date = fmt::format("{:%F}", fmt::gmtime(std::time(nullptr)));
    writeFile(command.out / "preregistration.md", preregistration(protocol, plan, date));
    writeFigures(command.out, {powerCurves(plan)});
    fmt::print("{}\npreregistration: {}\nfigure: {}\n", planText(plan),
               (command.out / "preregistration.md").string(), (command.out / "power.svg").string());
}

} // namespace obscura
