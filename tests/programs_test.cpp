// Every program and subcommand, started with arguments that are right and with some that are not.
// What is silently taken for something else is a wrong measurement.
#include "base/files.h"
#include "tests/folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace obscura {
namespace {

using testing::HasSubstr;

struct Outcome {
    int status = -1;
    std::string said; // on both channels
};

Outcome run(const std::string& arguments) {
    const std::string command = fmt::format("'{}'/{} 2>&1 </dev/null", OBSCURA_BIN, arguments);
    std::FILE* pipe = ::popen(command.c_str(), "r");
    Outcome outcome;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe))
        outcome.said.append(buffer, count);
    const int status = ::pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

const std::string camera = " --camera 0 2 8 0 1 0";
const std::string tiny = camera + " --width 32 --height 18 --antialiasing 1";
const std::string small = tiny + " --out @/o.png";

TEST(Programs, ExplainThemselves) {
    for (const char* program : {"obscura-render",          "obscura-render compare",
                                "obscura-stimuli",         "obscura-stimuli match",
                                "obscura-experiment",      "obscura-experiment ledger",
                                "obscura-analysis",        "obscura-archive",
                                "obscura-bench",           "obscura-bench rays",
                                "obscura-bench normals",   "obscura-bench passes",
                                "obscura-bench sweep",     "obscura-bench merge",
                                "obscura-bench page",      "obscura-bench ablation",
                                "obscura-bench status",    "obscura-bench choose",
                                "obscura-bench stability", "obscura-view"}) {
        const Outcome outcome = run(std::string(program) + " --help");
        EXPECT_EQ(outcome.status, 0) << program;
        EXPECT_THAT(outcome.said, HasSubstr("Usage:")) << program;
        EXPECT_NE(run(std::string(program) + " --no-such-option").status, 0) << program;
    }
}

TEST(Programs, TakeRightArguments) {
    const test::Folder folder;
    for (const std::string& arguments :
         {std::string("obscura-render --list"), std::string("obscura-render --describe hbao"),
          "obscura-render --technique hbao --set steps=4 --set blur=0" + small,
          "obscura-render --technique gtao --preset low" + small,
          "obscura-render --near 0.01 --fov 60 --exposure -1.5" + small,
          std::string("obscura-analysis --out @/report --counts '" OBSCURA_SOURCE
                      "/analysis/thesis_table4.csv'"),
          "obscura-bench passes 'hbao steps=4 blur=0' --seconds 0 --width 64 --height 36" +
              camera}) {
        const Outcome outcome = run(replaced(arguments, "@", folder.path().string()));
        EXPECT_EQ(outcome.status, 0) << arguments << "\n" << outcome.said;
    }
}

// What --frame prints gives the same picture again when it is typed.
TEST(Programs, FrameAScene) {
    const test::Folder folder;
    const auto at = [&](const std::string& text) {
        return replaced(text, "@", folder.path().string());
    };
    // The three corners (0, 0, 0), (1, 0, 0) and (0, 1, 0).
    writeFile(folder / "triangle.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
"scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
               "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36,
             "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    const std::string scene =
        "obscura-render --scene triangle.gltf --scenes @ --width 64 --height 36 --antialiasing 1";
    const Outcome framed = run(at(scene + " --frame --out @/a.png"));
    ASSERT_EQ(framed.status, 0) << framed.said;
    EXPECT_THAT(framed.said, HasSubstr("\ncamera = { position = ["));
    const std::size_t options = framed.said.find("--camera ");
    ASSERT_NE(options, std::string::npos) << framed.said;
    const std::string typed =
        framed.said.substr(options, framed.said.find('\n', options) - options);
    ASSERT_EQ(run(at(scene + " --out @/b.png " + typed)).status, 0) << typed;
    EXPECT_EQ(readFile(folder / "a.png"), readFile(folder / "b.png"));
}

// Every metric and every map, of a picture and its negative in one channel.
TEST(Programs, CompareTwoPictures) {
    const test::Folder folder;
    const auto at = [&](const std::string& text) {
        return replaced(text, "@", folder.path().string());
    };
    ASSERT_EQ(run(at("obscura-render --set blur=0 --technique crytek --out @/a.png" + tiny)).status,
              0);
    ASSERT_EQ(run(at("obscura-render --out @/b.png" + tiny)).status, 0);
    const Outcome same = run(at("obscura-render compare @/a.png @/a.png --json"));
    EXPECT_EQ(same.status, 0) << same.said;
    for (const char* line : {"\"rmse\": 0.0,", "\"ssim\": 1.0,", "\"flip\": 0.0,", "\"jod\": 10.0",
                             "\"distanceCm\": 60.0,"})
        EXPECT_THAT(same.said, HasSubstr(line));
    const Outcome apart = run(at("obscura-render compare @/b.png @/a.png --display laptop "
                                 "--display peak=100 --maps @/maps"));
    EXPECT_EQ(apart.status, 0) << apart.said;
    EXPECT_THAT(apart.said, HasSubstr("predicted"));
    EXPECT_THAT(apart.said, HasSubstr("15.4-inch, 1280 x 800 pixels, from 60 cm"));
    EXPECT_THAT(apart.said, Not(HasSubstr("JOD   10")));
    for (const char* map : {"difference", "ssim", "flip", "jod"})
        EXPECT_GT(std::filesystem::file_size(folder / ("maps/" + std::string(map) + ".png")), 1000u)
            << map;
}

TEST(Programs, RefuseToCompareWhatCannotBe) {
    const test::Folder folder;
    const auto at = [&](const std::string& text) {
        return replaced(text, "@", folder.path().string());
    };
    ASSERT_EQ(run(at("obscura-render --out @/a.png" + tiny)).status, 0);
    ASSERT_EQ(
        run(at("obscura-render --out @/b.png --antialiasing 1 --width 32 --height 20" + camera))
            .status,
        0);
    const auto says = [&](const std::string& arguments, const std::string& words) {
        const Outcome outcome = run(at("obscura-render compare " + arguments));
        EXPECT_NE(outcome.status, 0) << arguments;
        EXPECT_THAT(outcome.said, HasSubstr(at(words)));
    };
    says("@/a.png @/b.png", "expected two pictures of one size, found @/a.png of 32 x 18 and "
                            "@/b.png of 32 x 20 pixels");
    says("@/a.png @/none.png", "@/none.png");
    says("@/a.png @/a.png --display standart_fhd", "did you mean \"standard_fhd\"?");
    says("@/a.png", "reference");
}

struct Mistake {
    std::string arguments; // "@" is a folder of the test's own
    std::string says;
};

TEST(Programs, RefuseWrongOnes) {
    const test::Folder folder;
    const std::string sweep =
        "obscura-bench sweep '" OBSCURA_SOURCE "/protocols/sweep-builtin.toml'"
        " --quick --out @/sweep ";
    const std::string choose = "obscura-bench choose --quick --out @/choose ";
    const std::vector<Mistake> mistakes = {
        {"obscura-render --technique hbao --set blur=yes" + small, "blur=NUMBER"},
        {"obscura-render --technique hbao --set angleBias=abc" + small, "angleBias=NUMBER"},
        {"obscura-render --technique hbao --set angleBias=10abc" + small,
         "found \"angleBias=10abc\""},
        {"obscura-render --technique hbao --set blur" + small, "NAME=NUMBER, found \"blur\""},
        {"obscura-render --technique hbao --set blurr=1" + small, "did you mean \"blur\"?"},
        {"obscura-render --technique hbao --set steps=1.5" + small, "steps"},
        {"obscura-render --technique hbao --set steps=nan" + small, "steps=NUMBER"},
        {"obscura-render --technique hbaoo" + small, "did you mean \"hbao\"?"},
        {"obscura-render --technique hbao --preset best" + small, "best"},
        {"obscura-render --radius nan" + small, "expected a number from 0.0001 to 10000"},
        {"obscura-render --radius -1" + small, "expected a number from 0.0001 to 10000"},
        {"obscura-render --fov 190" + small, "expected a number from 1 to 170"},
        {"obscura-render --near 0" + small, "expected a number from 1e-07"},
        {"obscura-render --exposure inf" + small, "expected a number from -32 to 32"},
        {"obscura-render --camera nan 0 0 1 0 0", "expected a number from"},
        {"obscura-render --scene sculpture", "or --frame, which finds a view"},
        {"obscura-render --frame" + camera, "--camera excludes --frame"},
        {"obscura-render --camera 0 0 0 0 0 0 --width 32 --height 18 --out @/o.png",
         "a target apart from the position"},
        {"obscura-render --camera 0 5 0 0 0 0 --width 32 --height 18 --out @/o.png",
         "along \"up\""},
        {"obscura-render --width 0" + camera, "--width"},
        {"obscura-render --scene absent.gltf" + small,
         "absent.gltf: expected a glTF scene, found no"},
        {"obscura-render --reference @/r.exr --rays 0" + camera, "--rays"},
        {"obscura-render --protocol @/absent.toml --condition x", "absent.toml"},
        {"obscura-stimuli @/absent.toml", "absent.toml: cannot be read"},
        {"obscura-stimuli", "protocol is required"},
        {"obscura-stimuli match '" OBSCURA_SOURCE "/protocols/match-builtin.toml' --radius nan",
         "expected a number from"},
        {"obscura-experiment --stimuli @ --protocol @/absent.toml", "obscura-experiment:"},
        {"obscura-experiment --windowed 12 --protocol '" OBSCURA_SOURCE
         "/protocols/demo.toml' --stimuli @",
         "obscura-experiment:"},
        {"obscura-experiment ledger --protocol '" OBSCURA_SOURCE "/protocols/demo.toml' --void 0",
         "--void"},
        {"obscura-analysis @/absent", "absent: expected a study's folder or a CSV file"},
        {"obscura-analysis --counts @/absent.csv", "absent.csv: cannot be read"},
        {"obscura-bench passes 'hbao steps=x'", "hbao steps=NUMBER"},
        {"obscura-bench passes 'hbao stepz=4'", "did you mean \"steps\"?"},
        {"obscura-bench passes hbao --seconds -1", "expected a number from 0 to 86400"},
        {"obscura-bench passes hbao --radius nan", "expected a number from 0.0001"},
        {"obscura-bench rays --fov 0", "expected a number from 1 to 170"},
        {"obscura-bench normals --camera 1 2 3", "--camera"},
        {sweep + "--seconds nan", "expected a number from 0 to 86400"},
        {sweep + "--hours nan", "expected a number from 0"},
        {sweep + "--size 0x100", "expected --size WIDTHxHEIGHT"},
        {sweep + "--size 320", "expected --size WIDTHxHEIGHT"},
        {sweep + "--display crt", "--display: expected the name of a display"},
        {sweep + "--part 3/2", "expected --part I/N"},
        {sweep + "--measure speed", "--measure"},
        {choose + "--limit rmse", "--limit NAME=NUMBER, found \"rmse\""},
        {choose + "--limit rmsee=0.1", "did you mean \"rmse\"?"},
        {choose + "--limit rmse=0,1", "found \"rmse=0,1\""},
        {choose + "--limit rmse=-1", "at least 0"},
        {choose + "--limit rmse=0.1 --must-pass thinn", "thinn"},
        {"obscura-bench merge @/one @/two --out @/all", "one"},
        {"obscura-bench page @", "sweep.json"},
        {"obscura-bench ablation @", "sweep.json"},
        {"obscura-bench status @", "a plan of its units, found none"},
        {"obscura-bench stability --technique 'hbao blur=yes' --test plane --out @/s",
         "blur=NUMBER"},
        {"obscura-bench stability --radius 0 --test dolly --out @/s", "expected a number from"},
        {"obscura-bench stability --test plain --out @/s", "plain"},
    };
    for (const Mistake& mistake : mistakes) {
        const Outcome outcome = run(replaced(mistake.arguments, "@", folder.path().string()));
        EXPECT_GT(outcome.status, 0) << mistake.arguments << "\n" << outcome.said;
        EXPECT_THAT(outcome.said, HasSubstr(mistake.says)) << mistake.arguments;
    }
}

} // namespace
} // namespace obscura
