#include "base/argument_table.h"
#include "base/error.h"
#include "base/files.h"
#include "base/manual.h"
#include "base/program.h"
#include "base/shipped.h"
#include "base/version.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A little of everything that our programs declare.
void declare(CLI::App& app) {
    static std::string text, level = "low";
    static std::vector<double> camera;
    static std::filesystem::path path;
    static int count = 3;
    static bool flag = false;
    app.add_option("--level", level, "light\\dark")
        ->check(CLI::IsMember({"low", "high"}))
        ->capture_default_str();
    app.add_option("-c,--camera", camera, "where from")->expected(6);
    app.add_option("--hidden", text)->group("");
    CLI::App* command = app.add_subcommand("sweep", "everything, in turn");
    command->add_option("study", path, ".toml of it")->required();
    CLI::Option* quiet = command->add_flag("--quick", flag, "a first look");
    command->add_option("--count", count, "How many.")->check(CLI::Range(1, 9))->excludes(quiet);
    command->add_option("--out", path, "Folder, \"new\"")->option_text("DIR=here");
}

int body(CLI::App& app, int argc, char** argv) {
    declare(app);
    app.require_subcommand(1);
    app.parse(argc, argv);
    if (app.get_subcommand("sweep")->count("--quick") > 0)
        throw Error("expected patience");
    return 7;
}

struct Outcome {
    int status;
    std::string out, err;
};

Outcome run(std::vector<std::string> words) {
    words.insert(words.begin(), "/some/where/obscura-test");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = runProgram("obscura-test", "tests a program", body,
                                  static_cast<int>(arguments.size()), arguments.data());
    std::string out = testing::internal::GetCapturedStdout();
    return {status, std::move(out), testing::internal::GetCapturedStderr()};
}

TEST(ProgramTest, SaysItsVersionAndWhatItIsFor) {
    const Outcome asked = run({"--version"});
    EXPECT_EQ(asked.status, 0);
    EXPECT_EQ(asked.out,
              "obscura-test " + std::string(version()) + " (" + std::string(commit()) + ")\n");
    const Outcome help = run({"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.out, AllOf(StartsWith("tests a program\n"), HasSubstr("Usage: obscura-test"),
                                Not(HasSubstr("--describe-into"))));
}

TEST(ProgramTest, EndsWithTheBodysStatusOrOneLineOfWhatWentWrong) {
    EXPECT_EQ(run({"sweep", "a.toml"}).status, 7);
    const Outcome failed = run({"sweep", "a.toml", "--quick"});
    EXPECT_EQ(failed.status, 1);
    EXPECT_EQ(failed.err, "obscura-test: expected patience\n");
    const Outcome misspelt = run({"sweep", "a.toml", "--levl"});
    EXPECT_GT(misspelt.status, 1);
    EXPECT_THAT(misspelt.err, HasSubstr("--levl"));
}

TEST(ProgramTest, DescribesItselfWhateverElseIsRequired) {
    const test::Folder folder;
    const Outcome outcome = run({"--describe-into", folder.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(readFile(folder / "man/man1/obscura-test.1"), StartsWith(".TH OBSCURA\\-TEST 1"));
    const auto table = readArgumentTable(argumentTableFile(folder / "obscura", "obscura-test"));
    ASSERT_FALSE(table.empty());
    EXPECT_EQ(table.front().kind, Argument::Kind::program);
    EXPECT_EQ(table.front().name, "obscura-test");
    EXPECT_EQ(table.front().about, "tests a program");
}

std::string said(const Argument& argument) {
    return fmt::format("{} {} {} {} [{}] {}", static_cast<int>(argument.kind), argument.command,
                       argument.name, argument.values, argument.takes, argument.about);
}

TEST(ArgumentTableTest, HasEveryArgumentButTheHidden) {
    CLI::App app("", "obscura-test");
    declare(app);
    const test::Folder folder;
    writeFile(folder / "table.csv", argumentTable(app, "tests"));
    std::vector<std::string> lines;
    for (const Argument& argument : readArgumentTable(folder / "table.csv"))
        if (argument.name != "--help")
            lines.push_back(said(argument));
    EXPECT_THAT(lines,
                testing::ElementsAre(
                    "0  obscura-test 0 [] tests", "2  --level 1 [low high] light\\dark",
                    "2  --camera 6 [] where from", "1  sweep 0 [] everything, in turn",
                    "3 sweep study 1 [FILE] .toml of it", "2 sweep --quick 0 [] a first look",
                    "2 sweep --count 1 [] How many.", "2 sweep --out 1 [DIR] Folder, \"new\""));
}

TEST(ManualTest, SaysWhatHelpAndDeclarationSay) {
    CLI::App app("tests a program", "obscura-test");
    declare(app);
    app.footer("Keys: none.\n'Quoted' lines\n\n.and dots");
    const std::string page = manualOf(app, "tests a program");
    for (const char* text :
         {".SH NAME\nobscura\\-test \\- tests a program\n",
          "\\fBobscura\\-test\\fR [\\fIOPTIONS\\fR]\n.br\n"
          "\\fBobscura\\-test sweep\\fR [\\fIOPTIONS\\fR] \\fIstudy\\fR\n",
          ".SH DESCRIPTION\nTests a program.\n",
          ".TP\n\\fB\\-\\-level\\fR low|high\nLight\\edark. Default: low.\n",
          ".TP\n\\fB\\-c\\fR, \\fB\\-\\-camera\\fR \\fIFLOAT\\fR ...\nWhere from.\n",
          ".SS obscura\\-test sweep\nEverything, in turn.\n",
          // A line that begins with a dot would be a request to man.
          ".TP\n\\fIstudy\\fR\n\\&.toml of it. Required.\n",
          ".TP\n\\fB\\-\\-quick\\fR\nA first look. Not with \\fB\\-\\-count\\fR.\n",
          "\nHow many. From 1 to 9. Not with \\fB\\-\\-quick\\fR.\n",
          ".TP\n\\fB\\-\\-out\\fR \\fIDIR\\fR\nFolder, \"new\". Default: here.\n",
          ".SH NOTES\nKeys: none.\n.br\n\\&'Quoted' lines\n.PP\n\\&.and dots\n"})
        EXPECT_THAT(page, HasSubstr(text));
    EXPECT_THAT(page, Not(HasSubstr("hidden")));
}

// Tests lie in the build folder, beside the programs' own.
TEST(ShippedTest, IsFoundBesideTheProgramFromAnywhere) {
    EXPECT_EQ(shipped("shaders"), std::filesystem::path(OBSCURA_SOURCE) / "renderer/shaders");
    EXPECT_TRUE(std::filesystem::exists(shipped("protocols/demo.toml")));
    EXPECT_THAT(test::errorOf([] { shipped("nothing"); }),
                AllOf(HasSubstr("share/obscura/nothing"), HasSubstr("install Obscura anew")));
}

} // namespace
} // namespace obscura
