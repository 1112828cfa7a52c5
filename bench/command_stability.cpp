#include "bench/commands.h"
#include "bench/stability.h"
#include "protocols/progress.h"
#include "renderer/gl/context.h"

#include <fmt/format.h>

namespace obscura {

namespace {

struct Options {
    StabilityOptions stability;
    std::string device;
    bool quick = false, pageOnly = false;
};

int run(Options options) {
    StabilityOptions& stability = options.stability;
    if (options.pageOnly) {
        writeStabilityPage(stability.folder);
        return 0;
    }
    const gl::Context context(options.device);
    if (options.quick)
        stability.size.height = 108;
    stability.size.height += stability.size.height % 2;
    stability.size.width = stability.size.height * 8 / 9 * 2;
    if (stability.configurations.empty())
        stability.configurations = screenTechniques();
    Progress progress("stability", 1);
    runStability(stability,
                 [&](double done, const std::string& note) { progress.update(done, note); });
    progress.update(1);
    fmt::print("{}\n", (stability.folder / "stability.html").string());
    return 0;
}

} // namespace

std::vector<Command> stabilityCommands(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    StabilityOptions& stability = options->stability;
    stability.folder = "stability";
    CLI::App* command = app.add_subcommand("stability", "where techniques fail");
    command->add_option("--out", stability.folder, "result folder")->capture_default_str();
    command->add_option("--technique", stability.configurations,
                        "id, or \"id setting=value ...\"; may be repeated; default: all");
    command->add_option("--height", stability.size.height, "lines of the tests' images")
        ->check(CLI::Range(72, 2160))
        ->capture_default_str();
    command->add_flag("--quick", options->quick, "smaller images: 108 lines");
    command->add_flag("--page", options->pageOnly, "only make the page anew from the folder's CSV");
    command->add_option("--device", options->device, "as obscura-render --devices lists it");
    return {{command, [options] { return run(*options); }}};
}

} // namespace obscura
