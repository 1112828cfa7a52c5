// A real study through rendering, simulated participants and analysis into an archive, and back.
#include "archive/check.h"
#include "archive/contents.h"
#include "archive/sums.h"
#include "base/files.h"
#include "image/image.h"
#include "tests/archive/real_study.h"
#include "tests/error_of.h"
#include "tests/experiment/bids.h"
#include "tests/experiment/psych_ds.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::archived;
using test::checked;
using test::copied;
using test::errorOf;
using test::realStudy;
using test::renewSums;
using test::replaceIn;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

enum Row { sums, parts, stimuli, bids, pictures, results, rows };

class ArchiveTest : public testing::Test {
  protected:
    // An archive as a folder, to be changed.
    fs::path archive() {
        const fs::path path = folder_ / "archive";
        if (!fs::exists(path))
            archived(realStudy().places, path);
        return path;
    }
    // Which rows have something that differs; that of checksums is left out where they were
    // renewed.
    static std::vector<int> differing(const std::vector<Checked>& all) {
        std::vector<int> found;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (!all[i].differs.empty())
                found.push_back(static_cast<int>(i));
        return found;
    }

    test::Folder folder_;
};

TEST_F(ArchiveTest, HoldsAllOfAStudyAndIsOneOfTheStandards) {
    for (const char* file :
         {"README.md", "LICENCES.md", "SHA256SUMS", "dataset_description.json", "participants.tsv",
          "stimuli/manifest.json", "stimuli/contact-sheet.png", "code/archive.json",
          "code/protocol/p/tiny.toml", "code/protocol/matched/matched.toml",
          "sourcedata/tiny/sessions/ledger.jsonl", "sourcedata/tiny/sessions/design.json",
          "sourcedata/tiny/dataset_description.json", "derivatives/obscura-analysis/report.html",
          "derivatives/obscura-analysis/results.json", "derivatives/obscura-analysis/results.csv",
          "derivatives/obscura-analysis/votes.csv"})
        EXPECT_TRUE(fs::is_regular_file(archive() / file)) << file;
    EXPECT_FALSE(fs::is_empty(archive() / "derivatives/obscura-analysis/figures"));
    EXPECT_THAT(test::bidsFaults(archive()), IsEmpty());
    EXPECT_THAT(test::psychDsFaults(archive() / "sourcedata/tiny"), IsEmpty());
    const std::string command =
        "cd '" + archive().string() + "' && sha256sum --strict --quiet -c SHA256SUMS";
    EXPECT_EQ(std::system(command.c_str()), 0);
    bool installed = false;
    EXPECT_THAT(test::validatorFaults(archive(), installed), IsEmpty());
    if (!installed)
        GTEST_SKIP() << "bids-validator is not installed: only our own checker has looked. npm "
                        "install bids-validator@1, and OBSCURA_BIDS_VALIDATOR=.../bids-validator";
}

TEST_F(ArchiveTest, SaysOfWhatNobodyKnowsTheLicence) {
    const std::string text = readFile(archive() / "LICENCES.md");
    EXPECT_THAT(text, HasSubstr("| the study: protocol, answers, results, and the pictures as far "
                                "as they are ours | **unknown** |"));
    EXPECT_THAT(text, HasSubstr("scene `corner/t.gltf`"));
    EXPECT_THAT(text, HasSubstr("see corner/LICENSE.txt"));
}

TEST_F(ArchiveTest, TheSameStudyGivesTheSameBytes) {
    archived(realStudy().places, folder_ / "one.zip");
    archived(copied(folder_ / "elsewhere"), folder_ / "two.zip");
    EXPECT_EQ(sha256File(folder_ / "one.zip"), sha256File(folder_ / "two.zip"));
}

TEST_F(ArchiveTest, HoldsWhenCheckedAsFolderAndAsZip) {
    archived(realStudy().places, folder_ / "study.zip");
    for (const fs::path& path : {archive(), folder_ / "study.zip"}) {
        const std::vector<Checked> all = checked(path);
        ASSERT_EQ(all.size(), rows) << textOf(all);
        EXPECT_TRUE(isSound(all)) << textOf(all);
        for (const Checked& each : all) {
            EXPECT_GT(each.same, 0) << each.what;
            EXPECT_EQ(each.same, each.count()) << each.what;
        }
        EXPECT_EQ(all[pictures].same, 4);
        EXPECT_GT(all[results].same, 200);
    }
}

TEST_F(ArchiveTest, OneChangedByteIsFoundAndNamed) {
    const std::string image = "stimuli/first_a_crytek.png",
                      table = "sourcedata/tiny/sessions/ledger.jsonl",
                      result = "derivatives/obscura-analysis/votes.csv";
    for (const std::string& file : {image, table, result}) {
        const std::string before = readFile(archive() / file);
        std::string other = before;
        other[other.size() / 2] = static_cast<char>(other[other.size() / 2] ^ 1);
        writeFile(archive() / file, other);
        const std::vector<Checked> all = checked(archive());
        EXPECT_FALSE(isSound(all));
        EXPECT_THAT(all[sums].differs,
                    ElementsAre(file + " has changed: its SHA-256 is not that of the list"));
        EXPECT_THAT(textOf(all), HasSubstr("differs: " + file));
        writeFile(archive() / file, before);
    }
    EXPECT_TRUE(isSound(checked(archive())));
}

// Whoever changes something on purpose renews the checksums; all the rest still tells.
TEST_F(ArchiveTest, ChangedImagesAreFoundWithoutChecksums) {
    const fs::path file = archive() / "stimuli/first_a_crytek.png";
    Image8 image = readImage8(file);
    image.pixels[100] ^= 1;
    writePng(file, image);
    renewSums(archive());
    const std::vector<Checked> all = checked(archive());
    EXPECT_THAT(differing(all), testing::IsSupersetOf({int{stimuli}, int{pictures}}));
    EXPECT_THAT(all[stimuli].differs,
                ElementsAre("stimuli/first_a_crytek.png is not the file that the manifest vouches "
                            "for"));
    EXPECT_THAT(all[pictures].differs,
                ElementsAre(HasSubstr("first_a_crytek.png: RMSE 4.72e-05, at most 0.00392")));
}

// Only rendering tells of a picture of visibility, whose hash is the manifest's alone.
TEST_F(ArchiveTest, ChangedLayersAreFoundByRendering) {
    const fs::path file = archive() / "stimuli/first_a_crytek_ao.png";
    const std::string before = sha256File(file);
    Image8 image = readImage8(file);
    image.pixels[100] ^= 1;
    writePng(file, image);
    replaceIn(archive() / "stimuli/manifest.json", before, sha256File(file));
    renewSums(archive());
    EXPECT_THAT(differing(checked(archive())), ElementsAre(pictures));
}

TEST_F(ArchiveTest, ChangedAnswersAreFoundWithoutChecksums) {
    const fs::path data = archive() / "sourcedata/tiny/data";
    const fs::path file = fs::directory_iterator(data)->path();
    std::string text = readFile(file);
    // Of the last row the choice, wherever it stands.
    const bool choseA = text.rfind(",a,") != text.npos;
    ASSERT_TRUE(choseA || text.rfind(",b,") != text.npos);
    text.replace(text.rfind(choseA ? ",a," : ",b,"), 3, choseA ? ",b," : ",a,");
    writeFile(file, text);
    renewSums(archive());
    const std::vector<Checked> all = checked(archive());
    EXPECT_THAT(differing(all), testing::Contains(int{bids})) << textOf(all);
}

TEST_F(ArchiveTest, ChangedResultsAreFoundWithoutChecksums) {
    const fs::path file = archive() / "derivatives/obscura-analysis/votes.csv";
    const std::string text = readFile(file);
    const std::size_t row = text.find('\n') + 1, digit = text.find_first_of("123456789", row);
    std::string other = text;
    other[digit] = other[digit] == '9' ? '8' : static_cast<char>(other[digit] + 1);
    writeFile(file, other);
    renewSums(archive());
    const std::vector<Checked> all = checked(archive());
    EXPECT_THAT(differing(all), ElementsAre(results));
    EXPECT_THAT(all[results].differs, ElementsAre(HasSubstr("votes.csv: ")));
}

TEST_F(ArchiveTest, ResultsOfAnotherVersionAreHeldByTheirNumbers) {
    const fs::path folder = archive() / "derivatives/obscura-analysis";
    replaceIn(folder / "results.json", "\"commit\": \"", "\"commit\": \"other");
    replaceIn(folder / "results.json", "Few look better", "Few look worse");
    renewSums(archive());
    const std::vector<Checked> all = checked(archive());
    EXPECT_TRUE(isSound(all)) << textOf(all);
    EXPECT_THAT(all[results].remarks, testing::Contains(HasSubstr("were made by")));
    EXPECT_THAT(all[results].remarks, testing::Contains(HasSubstr("Few look worse")));
}

TEST_F(ArchiveTest, ScenesThatAreNotHereAreToldAndNoFault) {
    for (const bool isOther : {false, true}) {
        fs::path scenes = folder_ / "scenes";
        if (isOther) {
            std::string buffer = readFile(realStudy().scenes / "corner/t.bin");
            buffer[2] = static_cast<char>(buffer[2] ^ 1);
            writeFile(scenes / "corner/t.bin", buffer);
            writeFile(scenes / "corner/t.gltf", readFile(realStudy().scenes / "corner/t.gltf"));
        }
        const std::vector<Checked> all = checked(archive(), scenes);
        EXPECT_TRUE(isSound(all)) << textOf(all);
        EXPECT_EQ(all[pictures].notHere.size(), 4u);
        EXPECT_THAT(textOf(all),
                    HasSubstr(isOther ? "cannot be checked here (4 of them): the scene "
                                        "corner/t.gltf in "
                                      : "cannot be checked here (4 of them): the scene "
                                        "corner/t.gltf is not in "));
    }
}

TEST_F(ArchiveTest, ScenesOnRequestComeAlong) {
    archived(realStudy().places, archive(), true);
    for (const char* file : {"t.gltf", "t.bin", "LICENSE.txt"})
        EXPECT_TRUE(fs::exists(archive() / "stimuli/scenes/corner" / file)) << file;
    const std::vector<Checked> all = checked(archive(), folder_ / "nowhere");
    EXPECT_EQ(all[pictures].same, 4);
}

// A manifest that was written on another machine, whose driver rounds otherwise.
TEST_F(ArchiveTest, AnotherDriverMayRound) {
    const fs::path manifest = archive() / "stimuli/manifest.json";
    std::string text = readFile(manifest);
    for (std::size_t at = 0; (at = text.find("\"renderer\": \"", at)) != text.npos; at += 20)
        text.insert(at + 13, "Another");
    const fs::path file = archive() / "stimuli/first_a_crytek_ao.png";
    const std::string before = sha256File(file);
    const auto change = [&](std::uint8_t by) {
        Image8 image = readImage8(file);
        for (std::size_t i = 0; i < image.pixels.size(); i += 2)
            image.pixels[i] ^= by;
        writePng(file, image);
        std::string renewed = text;
        renewed.replace(renewed.find(before), before.size(), sha256File(file));
        writeFile(manifest, renewed);
        renewSums(archive());
        return checked(archive());
    };
    const std::vector<Checked> rounded = change(1);
    EXPECT_TRUE(isSound(rounded)) << textOf(rounded);
    EXPECT_EQ(rounded[pictures].nearly, 1);
    EXPECT_EQ(rounded[pictures].same, 3);
    EXPECT_THAT(textOf(rounded), HasSubstr("the driver is another (gl.renderer: \"Another"));
    EXPECT_THAT(textOf(rounded), HasSubstr("RMSE at most 0.0028"));
    EXPECT_THAT(differing(change(32)), ElementsAre(pictures)) << "more than rounding";
}

TEST_F(ArchiveTest, WhatIsNoArchiveIsAnError) {
    EXPECT_THAT(errorOf([&] { checked(folder_.path()); }), HasSubstr("found no SHA256SUMS"));
    EXPECT_THAT(errorOf([&] { checked(folder_ / "none"); }), HasSubstr("expected an archive"));
    writeFile(folder_ / "z.zip", "no zip");
    EXPECT_THAT(errorOf([&] { checked(folder_ / "z.zip"); }), HasSubstr("expected a zip file"));
}

// Each part damaged beyond reading is told, and whatever can be looked at still is.
TEST_F(ArchiveTest, DamagedPartsAreToldAndSurvived) {
    for (const char* file :
         {"code/archive.json", "code/protocol/p/tiny.toml", "code/protocol/matched/matched.toml",
          "stimuli/manifest.json", "stimuli/second_b_few.png",
          "sourcedata/tiny/sessions/design.json", "derivatives/obscura-analysis/results.json",
          "derivatives/obscura-analysis/votes.csv"}) {
        const std::string before = readFile(archive() / file);
        for (const std::string& other :
             {std::string(), std::string("\0\xff{[", 4), before.substr(0, before.size() / 2)}) {
            writeFile(archive() / file, other);
            const std::vector<Checked> all = checked(archive());
            EXPECT_THAT(textOf(all), HasSubstr(std::string("differs: ") + file));
        }
        writeFile(archive() / file, before);
    }
}

// Paths within the archive that lead out of it are not followed.
TEST_F(ArchiveTest, PathsThatLeadOutAreRefused) {
    const auto told = [&](const char* file, const std::string& what, const std::string& by,
                          const char* says) {
        const std::string before = readFile(archive() / file);
        replaceIn(archive() / file, what, by);
        EXPECT_THAT(textOf(checked(archive())), HasSubstr(says)) << by;
        writeFile(archive() / file, before);
    };
    told("code/archive.json", "\"code/protocol/", "\"../../code/protocol/",
         "leads out of its folder");
    told("code/archive.json", "\"study\": \"tiny\"", "\"study\": \"../../x\"",
         "leads out of its folder");
    told("stimuli/manifest.json", "\"path\": \"", "\"path\": \"../../",
         "expected files in its folder, found \"../../");
    told("code/protocol/p/tiny.toml", "../matched/", "../../../../../../../dev/null#", "tiny.toml");
    told("code/protocol/p/tiny.toml", "../matched/matched.toml", "/dev/zero", "expected a file");
}

TEST_F(ArchiveTest, WhatDoesNotBelongTogetherIsRefused) {
    const auto refusal = [&](void (*change)(const StudyPlaces&)) {
        static int number = 0;
        const StudyPlaces places = copied(folder_ / ("other" + std::to_string(++number)));
        change(places);
        const fs::path out = folder_ / "refused.zip";
        const std::string error = errorOf([&] { archived(places, out); });
        EXPECT_FALSE(fs::exists(out));
        return error;
    };
    EXPECT_THAT(
        refusal([](const StudyPlaces& p) { writeFile(p.stimuli / "first_a_crytek.png", ""); }),
        HasSubstr("first_a_crytek.png: is not the file that the manifest vouches for"));
    EXPECT_THAT(
        refusal([](const StudyPlaces& p) { fs::remove(p.stimuli / "first_a_crytek_ao.png"); }),
        HasSubstr("expected a file that the manifest names"));
    EXPECT_THAT(
        refusal([](const StudyPlaces& p) { replaceIn(p.protocol, "seed = 3", "seed = 4"); }),
        HasSubstr("these stimuli were made from another version"));
    EXPECT_THAT(
        refusal([](const StudyPlaces& p) { replaceIn(p.protocol, "mask = 0.3", "mask = 0.4"); }),
        HasSubstr("another design than that of protocol and stimuli: trial.mask was 0.3, is "
                  "now 0.4"));
    EXPECT_THAT(refusal([](const StudyPlaces& p) {
                    fs::remove(p.data / "sessions/design.json");
                    replaceIn(p.protocol, "mask = 0.3", "mask = 0.4");
                }),
                HasSubstr("2: design_sha256: expected the design of protocol and stimuli"));
    EXPECT_THAT(refusal([](const StudyPlaces& p) {
                    replaceIn(p.results / "results.json", "\"votes_a\": ", "\"votes_a\": 1");
                }),
                HasSubstr("expected what these data give, found 1 other value(s), such as: "
                          "results.json: /"));
    EXPECT_THAT(refusal([](const StudyPlaces& p) { fs::remove(p.results / "tests.csv"); }),
                HasSubstr("tests.csv: it is missing"));
    EXPECT_THAT(refusal([](const StudyPlaces& p) {
                    replaceIn(p.results / "results.json", "\"made\"", "\"unmade\"");
                }),
                HasSubstr("expected results that say how they were made"));
    // Texts may change while a study runs.
    const StudyPlaces places = copied(folder_ / "texts");
    replaceIn(places.protocol, "question = \"q\"", "question = \"which?\"");
    archived(places, folder_ / "texts.zip");
}

// Notes and lists of names that somebody keeps with the data are not published.
TEST_F(ArchiveTest, WhatIsNotOursStaysWhereItIs) {
    const StudyPlaces places = copied(folder_ / "more");
    writeFile(places.data / "who-is-who.csv", "names");
    writeFile(places.data / "sessions/notes.txt", "notes");
    writeFile(places.stimuli / "mine.png", "mine");
    archived(places, folder_ / "archived");
    for (const char* name : {"sourcedata/tiny/who-is-who.csv", "sourcedata/tiny/sessions/notes.txt",
                             "stimuli/mine.png"})
        EXPECT_FALSE(fs::exists(folder_ / "archived" / name)) << name;
    EXPECT_EQ(sha256File(folder_ / "archived/SHA256SUMS"), sha256File(archive() / "SHA256SUMS"));
}

} // namespace
} // namespace obscura
