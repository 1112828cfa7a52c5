#include "experiment/command_line.h"

#include "protocols/reader/protocol_argument.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace obscura {

namespace {

CLI::Option* declareScreen(CLI::App& app, Arguments& arguments) {
    app.add_option("--monitor", arguments.monitor, "Which monitor, as --list-monitors counts them")
        ->type_name("N")
        ->capture_default_str();
    app.add_flag("--photodiode", arguments.photodiode,
                 "Show a square in the lower left corner that is white while an image is on view "
                 "and black otherwise, for a light sensor");
    return app
        .add_option("--windowed", arguments.windowSize,
                    "Rehearse in a window, of 1280x800 unless a size is given")
        ->type_name("WxH")
        ->expected(0, 1);
}

void declareTrigger(CLI::App& app, Arguments& arguments) {
    app.add_option("--trigger", arguments.trigger,
                   "Tell a receiver of each onset in a trial: tcp://HOST:PORT, udp://HOST:PORT, "
                   "serial:/dev/NAME, or lsl")
        ->type_name("WHERE");
}

void declareTools(CLI::App& app, Arguments& arguments) {
    for (const auto& [name, description] :
         {std::pair("card", "Measure the size of a screen's pixels with a card held to it"),
          std::pair("calibrate", "Measure the curve of a screen by eye and with a photometer")}) {
        CLI::App* tool = app.add_subcommand(name, description);
        tool->add_option("--data", arguments.data, "The data folder, which keeps it")
            ->type_name("DIR")
            ->capture_default_str();
        declareScreen(*tool, arguments);
    }
}

void declareTiming(CLI::App& app, Arguments& arguments) {
    CLI::App* timing = app.add_subcommand(
        "timing", "Hold grey masks between images as a trial does, and say how long they were");
    timing->add_option("--masks", arguments.timing.masks, "How many")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    timing->add_option("--seconds", arguments.timing.seconds, "How long each")
        ->type_name("S")
        ->check(CLI::Range(0.01, 3600.0))
        ->capture_default_str();
    timing->add_flag("--json", arguments.timing.json, "Print JSON instead of a table");
    timing
        ->add_option("--out", arguments.timing.out,
                     "Also write timing.json, and masks.csv with a line for each mask")
        ->type_name("DIR");
    declareScreen(*timing, arguments);
    declareTrigger(*timing, arguments);
}

} // namespace

void declare(CLI::App& app, Arguments& arguments) {
    takesProtocol(app.add_option("--protocol", arguments.protocol, "The study: a TOML file"));
    app.add_option("--stimuli", arguments.stimuli, "The folder that obscura-stimuli wrote for it")
        ->type_name("DIR");
    app.add_option("--data", arguments.data, "Where answers go; each study gets a folder in it")
        ->type_name("DIR")
        ->capture_default_str();
    app.add_option("--participant", arguments.participant,
                   "Pseudonym, letters and digits; asked for on the screen when not given")
        ->type_name("ID");
    app.add_option("--language", arguments.language,
                   "The participant's, a tag such as en or zh-Hans; chosen on the screen when not "
                   "given and the study has several")
        ->type_name("TAG");
    app.add_option("--session", arguments.session, "Which session of this participant")
        ->type_name("N")
        ->check(CLI::Range(1, 99))
        ->capture_default_str();
    CLI::Option* resume =
        app.add_flag("--resume", arguments.resume,
                     "Go on with the participant's session, which broke off: no trial is shown "
                     "twice. Without --participant, the screen asks");
    CLI::Option* windowed = declareScreen(app, arguments);
    declareTrigger(app, arguments);
    app.add_flag("--list-monitors", arguments.listMonitors, "Name the monitors, and end");
    app.add_option("--screen-mm", arguments.screenMm,
                   "Width and height of what the screen shows, in millimetres; otherwise what "
                   "obscura-experiment card has measured")
        ->type_name("WxH");
    CLI::Option* rehearse =
        app.add_flag("--rehearse", arguments.rehearse,
                     "Try the study out: takes no slot, and its rows go to rehearsals/ in the data "
                     "folder, marked as such; --windowed always does")
            ->excludes(resume);
    app.add_flag("--allow-untimed", arguments.allowUntimed,
                 "Go on, and without a warning on the screen, on a display whose times cannot be "
                 "relied on; every row says timestamp_source none");
    CLI::Option* simulate =
        app.add_option("--simulate", arguments.simulated,
                       "Run N simulated participants, without a window; as many as the protocol "
                       "plans when N is left out")
            ->type_name("N")
            ->expected(0, 1)
            ->check(CLI::Range(1, 100000))
            ->excludes(windowed)
            ->excludes(resume)
            ->excludes(rehearse);
    app.add_option("--seed", arguments.seed,
                   "Seed of the simulated participants; the protocol's when not given")
        ->type_name("S")
        ->needs(simulate);
    app.add_option("--observer", arguments.observer,
                   "By what they choose: preference (the protocol's simulatedPreference), or jod "
                   "(each image's predicted JOD in the stimuli's manifest)")
        ->type_name("WHAT")
        ->check(CLI::IsMember({"preference", "jod"}))
        ->capture_default_str()
        ->needs(simulate);
    app.add_flag("--visual", arguments.visual,
                 "Run them through the real window, full screen, by keys that they press")
        ->needs(simulate);
    CLI::Option* preview =
        app.add_option("--preview", arguments.preview,
                       "Draw every screen of a trial, and the pages around it, on one sheet (PNG), "
                       "without a window")
            ->type_name("FILE")
            ->excludes(windowed, rehearse, simulate);
    app.add_flag("--check", arguments.check,
                 "Prove that the study can be run to its end: all fits on the screen, and "
                 "simulated participants finish every slot. Needs no stimuli; given --stimuli, "
                 "their files are checked too")
        ->excludes(windowed, rehearse, simulate, preview);
    app.add_option("--size", arguments.size, "Of the screen, with --preview and --check")
        ->type_name("WxH")
        ->capture_default_str();

    declareLedger(app, arguments.ledger);
    declareTiming(app, arguments);
    declareTools(app, arguments);
    app.footer(
        "Keys: Space goes on; 1 and 2, the arrows or the mouse choose; Escape asks whether to "
        "end.\n"
        "Example: obscura-experiment --protocol protocols/demo.toml --stimuli stimuli-demo");
}

} // namespace obscura
