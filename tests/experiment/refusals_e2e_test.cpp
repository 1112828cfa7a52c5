#include "base/files.h"
#include "tests/experiment/desktop.h"
#include "tests/experiment/presented_study.h"
#include "tests/experiment/program.h"

#include <gmock/gmock.h>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Program;
using testing::HasSubstr;

// What cannot be shown ends the presenter before the session begins.
using Refusals = test::PresentedStudy;

TEST_F(Refusals, ATextThatNoFontCanShowIsRefusedBeforeTheSession) {
    open({.texts = "unfocused = \"Here: \\u0378\"\n"});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(program.output(),
                HasSubstr("texts.unfocused: no installed font can show U+0378; install one"));
    EXPECT_THAT(program.output(), HasSubstr("tiny.toml:"));
    EXPECT_FALSE(fs::exists(data)) << "no slot was claimed";
}

TEST_F(Refusals, AnImageLargerThanTheScreenIsRefused) {
    open({.width = 641});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(readFile(output), HasSubstr("images of 641x180 pixels do not fit on a screen of "
                                            "640x400, and are never scaled"));
    EXPECT_FALSE(fs::exists(data)) << "no slot was claimed";
}

// What only a break would show is looked at before the session, not in its middle.
TEST_F(Refusals, ABreaksTextThatDoesNotFitIsRefusedBeforeTheSession) {
    std::string words;
    for (int i = 0; i < 400; ++i)
        words += "rest a while, ";
    open({.texts = "rest = \"" + words + "\"\n"});
    test::Desktop desktop(width, height);
    Program program(desktop.name(), arguments({"--participant", "P01"}), output);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(readFile(output), HasSubstr("a text is too long for a screen of 640x400"));
    EXPECT_FALSE(fs::exists(data)) << "no slot was claimed";
}

// 320 pixels wide, they stand below each other: three of 180 do not fit into 400.
TEST_F(Refusals, ImagesThatDoNotFitBesideEachOtherAreRefused) {
    open({});
    const auto refusal = [&](const std::string& phase) {
        std::string text = readFile(study.protocol.path);
        const std::size_t trial = text.find("[trial]"), end = text.find("[ordering]");
        text.replace(trial, end - trial,
                     "[[trial.phases]]\nname = \"all\"\nimages = [1, 2, \"a\"]\n" + phase);
        const fs::path path = folder.path() / "beside.toml";
        writeFile(path, text);
        test::Desktop desktop(width, height);
        Program program(desktop.name(),
                        {"--protocol", path.string(), "--stimuli", study.manifest.folder.string(),
                         "--data", data.string(), "--participant", "P01"},
                        output);
        EXPECT_EQ(program.wait(), 1);
        return program.output();
    };
    EXPECT_THAT(refusal(""), HasSubstr("trial.phases[1]: 3 images of 320x180 pixels do not fit "
                                       "beside each other on a screen of 640x400"));
    EXPECT_THAT(refusal("questions = [ { name = \"q\", kind = \"rank\", text = \"question\" } ]\n"),
                HasSubstr("3 images of 320x180 pixels and what is asked beside them do not fit"));
    EXPECT_FALSE(fs::exists(data)) << "no slot was claimed";
}

TEST_F(Refusals, WithoutAScreenItSaysSo) {
    open({});
    Program program("", arguments({"--participant", "P01"}), output);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(readFile(output), HasSubstr("no screen to open a window on"));
}

} // namespace
} // namespace obscura
