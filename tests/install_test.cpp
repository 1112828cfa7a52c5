// Obscura as it is installed: in a folder of somebody's own, with nothing around it that it was
// built with. Whole packages are tried by scripts/package --try.
#include "base/files.h"
#include "base/version.h"
#include "tests/folder.h"
#include "tests/terminal.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <set>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct Outcome {
    int status = -1;
    std::string said; // on both channels
};

Outcome shell(const std::string& command) {
    std::FILE* pipe = ::popen(("exec 2>&1 </dev/null; " + command).c_str(), "r");
    Outcome outcome;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe))
        outcome.said.append(buffer, count);
    const int status = ::pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

bool isInstalled(const char* program) {
    return shell(fmt::format("command -v {}", program)).status == 0;
}

class InstalledTest : public testing::Test {
  protected:
    void SetUp() override {
        const Outcome outcome =
            shell(fmt::format("cmake --install '{}' --prefix '{}'", OBSCURA_BUILD, prefix()));
        ASSERT_EQ(outcome.status, 0) << outcome.said;
        for (const auto& entry : fs::directory_iterator(fs::path(prefix()) / "bin"))
            programs_.insert(entry.path().filename().string());
    }

    std::string prefix() const { return (folder_ / "with a blank").string(); }

    // A program of the installation, from / and with no environment.
    Outcome run(const std::string& arguments) const {
        return shell(fmt::format("cd / && env -i '{}'/bin/{}", prefix(), arguments));
    }

    const std::set<std::string>& programs() const { return programs_; }

  private:
    test::Folder folder_;
    std::set<std::string> programs_;
};

TEST_F(InstalledTest, ProgramsRunFromAnywhere) {
    for (const char* program :
         {"obscura", "obscura-analysis", "obscura-bench", "obscura-experiment", "obscura-render",
          "obscura-stimuli", "obscura-validity", "obscura-view"})
        EXPECT_TRUE(programs().contains(program)) << program;
    EXPECT_FALSE(programs().contains("obscura-frame-time")); // a tool of who builds
    for (const std::string& program : programs()) {
        const Outcome asked = run(program + " --version");
        EXPECT_EQ(asked.said, fmt::format("{} {} ({})\n", program, version(), commit()));
        EXPECT_EQ(asked.status, 0);
        const Outcome help = run(program + " --help");
        EXPECT_EQ(help.status, 0);
        EXPECT_THAT(help.said, HasSubstr("Usage: " + program));
    }
    // What they read: shaders, protocols and what these include, texts, the table's prose.
    const std::string picture = prefix() + "/o.png";
    const Outcome rendered =
        run(fmt::format("obscura-render --camera 0 2 8 0 1 0 --technique gtao --width 32 "
                        "--height 18 --antialiasing 1 --out '{}'",
                        picture));
    EXPECT_EQ(rendered.status, 0) << rendered.said;
    EXPECT_TRUE(fs::exists(picture));
    EXPECT_EQ(run("obscura-render --document").said,
              readFile(fs::path(OBSCURA_SOURCE) / "docs/techniques.md"));
    EXPECT_EQ(run("obscura-bench sweep --help").status, 0);
    const Outcome ledger = run(
        fmt::format("obscura-experiment ledger --protocol p910-acr --data '{}/data'", prefix()));
    EXPECT_EQ(ledger.status, 0) << ledger.said;
    EXPECT_THAT(run("obscura-stimuli demmo").said, HasSubstr("did you mean \"demo\"?"));
}

TEST_F(InstalledTest, NothingKnowsWhereItWasBuilt) {
    for (const auto& entry : fs::recursive_directory_iterator(prefix())) {
        ASSERT_FALSE(entry.is_symlink() && fs::read_symlink(entry.path()).is_absolute())
            << entry.path();
        const bool holdsPath = entry.is_regular_file() &&
                               readFile(entry.path()).find(OBSCURA_SOURCE) != std::string::npos;
        EXPECT_FALSE(holdsPath) << entry.path();
    }
}

TEST_F(InstalledTest, OneNameStartsEachProgram) {
    const Outcome list = run("obscura");
    EXPECT_EQ(list.status, 0);
    for (const std::string& program : programs())
        if (program != "obscura") {
            const std::string name = program.substr(std::string("obscura-").size());
            EXPECT_THAT(list.said, testing::ContainsRegex("\n  " + name + " +[a-z]"));
            EXPECT_THAT(run("obscura " + name + " --version").said,
                        testing::StartsWith(program + " "));
        }
    const Outcome mistake = run("obscura stimulli protocol.toml");
    EXPECT_EQ(mistake.status, 1);
    EXPECT_EQ(mistake.said, "obscura: expected the name of a program, found \"stimulli\"; did you "
                            "mean \"stimuli\"?\n");
    // Its arguments and its status are the program's.
    const Outcome refused = run("obscura stimuli /absent.toml");
    EXPECT_EQ(refused.status, 1);
    EXPECT_THAT(refused.said, HasSubstr("obscura-stimuli: /absent.toml: cannot be read"));
}

TEST_F(InstalledTest, ManualPagesAreWithoutFault) {
    if (!isInstalled("man") || !isInstalled("lexgrog"))
        GTEST_SKIP() << "needs man and lexgrog: apt install man-db";
    for (const std::string& program : programs()) {
        const std::string page = fmt::format("'{}/share/man/man1/{}.1'", prefix(), program);
        const Outcome faults = shell(fmt::format(
            "LC_ALL=C.UTF-8 MANROFFSEQ= MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z {} "
            "2>&1 >/dev/null",
            page));
        EXPECT_EQ(faults.said, "") << page;
        const Outcome shown = shell(fmt::format(
            "LC_ALL=C.UTF-8 MANWIDTH=80 MAN_KEEP_FORMATTING= man -l {} | col -b", page));
        for (const char* text : {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "--version"})
            EXPECT_THAT(shown.said, HasSubstr(text)) << page;
        // What apropos and whatis will find.
        EXPECT_THAT(shell("lexgrog " + page).said, HasSubstr("\"" + program + " - "));
    }
}

TEST(Release, HasItsEntryInTheChangelog) {
    const std::string log = readFile(fs::path(OBSCURA_SOURCE) / "CHANGELOG.md");
    const std::size_t newest = log.find("\n## [");
    ASSERT_NE(newest, log.npos);
    EXPECT_EQ(log.substr(newest + 5, log.find(']', newest) - newest - 5), version());
}

// An interactive shell in which ^X^P writes the line between signs and empties it. Keys are typed
// when it shows its prompt: before that the terminal, not the shell, would edit them.
class Shell {
  public:
    Shell(std::vector<std::string> program, const std::string& prefix, const std::string& setup)
        : terminal_(std::move(program),
                    {"PATH=" + prefix + "/bin:/usr/bin:/bin", "TERM=dumb", "HOME=" + prefix,
                     "INPUTRC=/dev/null", "LC_ALL=C.UTF-8", "PS1=" + prompt}) {
        terminal_.readUntil(prompt);
        terminal_.type(setup + "; cd '" + prefix + "'; echo rea''dy\n");
        started_ = terminal_.readUntil("ready").ends_with("ready");
        terminal_.readUntil(prompt);
    }

    // Whether it has done what it was set up by.
    bool started() const { return started_; }

    // What becomes of a line when Tab is pressed at its end.
    std::string completed(const std::string& typed) {
        terminal_.type(typed + "\t");
        return line();
    }

    // What is written when Tab is pressed twice, until `text` comes.
    std::string listed(const std::string& typed, const std::string& text) {
        terminal_.type(typed + "\t\t");
        std::string written = terminal_.readUntil(text);
        line();
        return written;
    }

  private:
    std::string line() {
        terminal_.type("\x18\x10");
        terminal_.readUntil("<<");
        const std::string line = terminal_.readUntil(">>");
        terminal_.readUntil(prompt);
        return line.substr(0, line.size() - std::min<std::size_t>(line.size(), 2));
    }

    static inline const std::string prompt = "shell: ";
    test::Terminal terminal_;
    bool started_ = false;
};

void expectCompletion(Shell& shell, const std::string& prefix) {
    const auto becomes = [&](const std::string& typed, const std::string& line) {
        EXPECT_EQ(shell.completed(typed), line) << typed;
    };
    becomes("obscura-bench swe", "obscura-bench sweep ");
    becomes("obscura-bench sweep --hou", "obscura-bench sweep --hours ");
    becomes("obscura-render --level mod", "obscura-render --level moderate ");
    becomes("obscura-render --level=mod", "obscura-render --level=moderate ");
    becomes("obscura-render compare --disp", "obscura-render compare --display ");
    becomes("obscura-analysis export --format ps", "obscura-analysis export --format psych-ds ");
    becomes("obscura-stimuli quest", "obscura-stimuli quest-plus ");
    becomes("obscura stim", "obscura stimuli ");
    becomes("obscura stimuli --verif", "obscura stimuli --verify ");
    becomes(
        "obscura bench choose --must-pass slo",
        shell.completed("obscura-bench choose --must-pass slo").replace(0, 13, "obscura bench"));
    // Files, with blanks; folders where only these will do.
    fs::create_directory(fs::path(prefix) / "folder");
    writeFile(fs::path(prefix) / "my study.toml", "");
    writeFile(fs::path(prefix) / "folder.csv", "");
    becomes("obscura-stimuli my", "obscura-stimuli my\\ study.toml ");
    becomes("obscura-analysis --out fol", "obscura-analysis --out folder/");
    becomes("obscura-analysis --csv folder.", "obscura-analysis --csv folder.csv ");
    EXPECT_THAT(shell.listed("obscura-render --level ", "moderate"), HasSubstr("high"));
}

TEST_F(InstalledTest, BashCompletes) {
    Shell bash({"bash", "--norc", "--noprofile", "-i"}, prefix(),
               "bind 'set bell-style none'; bind -x '\"\\C-x\\C-p\": echo \"<<$READLINE_LINE>>\"; "
               "READLINE_LINE='; "
               "source '" +
                   prefix() + "/share/bash-completion/completions/obscura-bench'");
    ASSERT_TRUE(bash.started());
    expectCompletion(bash, prefix());
}

TEST_F(InstalledTest, ZshCompletes) {
    if (!isInstalled("zsh"))
        GTEST_SKIP() << "needs zsh: apt install zsh";
    Shell zsh(
        {"zsh", "-f", "-i"}, prefix(),
        "fpath=('" + prefix() +
            "/share/zsh/site-functions' $fpath); autoload -U compinit; "
            "compinit -u -D; show() { zle -I; print -r \"<<$BUFFER>>\"; BUFFER= }; zle -N show; "
            "bindkey '^X^P' show");
    ASSERT_TRUE(zsh.started());
    expectCompletion(zsh, prefix());
    EXPECT_THAT(zsh.listed("obscura ", "view "), HasSubstr("-- "));
}

} // namespace
} // namespace obscura
