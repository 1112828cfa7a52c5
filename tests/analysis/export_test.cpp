#include "analysis/export/command.h"
#include "analysis/export/formats.h"
#include "base/csv.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <map>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using testing::HasSubstr;
using testing::Not;

using Table = std::vector<std::map<std::string, std::string>>;

Table tableOf(const std::string& csv) {
    const auto records = splitCsv(csv);
    Table table;
    for (std::size_t i = 1; i < records.size(); ++i)
        for (std::size_t cell = 0; cell < records[i].cells.size(); ++cell) {
            table.resize(i);
            table.back()[records[0].cells.at(cell)] = records[i].cells[cell];
        }
    return table;
}

class ExportTest : public testing::Test {
  protected:
    ExportTest() {
        options.study = test::writeStudy(folder_ / "study", 3);
        options.out = folder_ / "out";
        options.format = "bids";
        for (const char* id : {"P01", "P02", "P03"})
            writeLong(id);
    }

    // One trial of two phases and a question, as the presenter writes it.
    static TrialKey key(const std::string& id, const std::string& part) {
        TrialKey trial;
        trial.rowId = id + "-1-1-" + part;
        trial.studyId = "sample";
        trial.participantId = id;
        trial.sessionId = "1";
        trial.slotId = trial.trialIndex = 1;
        trial.conditionId = "c1";
        trial.level = "moderate";
        trial.scene = "atrium";
        trial.roles = "b>a";
        trial.techniques = "blizzard24>none";
        return trial;
    }
    static PhaseRow phase(const std::string& id, const std::string& name, double onset) {
        PhaseRow row;
        row.trial = key(id, name);
        row.phase = name;
        row.onsetMs = onset;
        row.viewMs = 500;
        row.refreshHz = 60;
        row.timestampSource = "finish";
        return row;
    }
    static AnswerRow answer(const std::string& id, const std::string& value,
                            const std::string& role) {
        AnswerRow row;
        row.trial = key(id, "choice");
        row.phase = "question";
        row.question = "choice";
        row.kind = "choice";
        row.value = value;
        row.role = role;
        row.responseMs = 250;
        return row;
    }

    fs::path file(const std::string& id, const std::string& kind) const {
        return options.study / "sessions" /
               ("study-sample_subject-" + id + "_session-1_" + kind + ".csv");
    }
    void writeAnswers(const std::string& id, const std::vector<AnswerRow>& rows) {
        std::string text = answerHeader();
        for (const AnswerRow& row : rows)
            text += answerLine(row);
        writeFile(file(id, "answers"), text);
    }
    void writeLong(const std::string& id) {
        PhaseRow shown = phase(id, "first", 1000);
        shown.images = "b";
        shown.files = "b.png";
        shown.sha256 = sha256("picture b");
        writeFile(file(id, "phases"),
                  phaseHeader() + phaseLine(shown) + phaseLine(phase(id, "question", 1500)));
        writeAnswers(id, {answer(id, "1", "b")});
    }
    void replace(const fs::path& path, const std::string& what, const std::string& with) {
        std::string text = readFile(path);
        ASSERT_NE(text.find(what), text.npos) << what;
        writeFile(path, text.replace(text.find(what), what.size(), with));
    }

    std::string refusal() const {
        return errorOf([this] { exportStudy(options); });
    }
    RecordedStudy study() const { return readStudy(options.study, options.simulated, false); }
    Table comparisons() const {
        std::vector<std::string> remarks;
        return tableOf(pwcmpFiles(study(), remarks).at("comparisons.csv").text);
    }

    test::Folder folder_;
    ExportOptions options;
};

TEST_F(ExportTest, NamesThePlaceOfWhatCannotBeRead) {
    replace(file("P02", "phases"), "500.000", "half");
    EXPECT_THAT(refusal(), HasSubstr("subject-P02_session-1_phases.csv:2:25: view_ms: expected a "
                                     "number from 0 to 1e9, found \"half\""));
    writeLong("P02");
    replace(file("P02", "answers"), "250.000", "nan");
    EXPECT_THAT(refusal(), HasSubstr("_answers.csv:2:24: response_ms: "));
    writeLong("P02");
    replace(file("P02", "phases"), "\n1,", "\n2,");
    EXPECT_THAT(refusal(), HasSubstr("_phases.csv:2:1: schema_version: expected 1, found 2"));
    writeLong("P02");
    replace(file("P02", "phases"), "view_ms", "view_s");
    EXPECT_THAT(refusal(), HasSubstr("view_s: unknown column; did you mean \"view_ms\"?"));
    writeLong("P02");
    const std::string text = readFile(file("P02", "answers"));
    writeFile(file("P02", "answers"), text.substr(0, text.size() - 60));
    EXPECT_THAT(refusal(), HasSubstr("_answers.csv:2: the line has no end: it was cut off"));
    EXPECT_FALSE(fs::exists(options.out));
    options.lenient = true;
    exportStudy(options);
}

TEST_F(ExportTest, RefusesWhatDoesNotBelongTogether) {
    replace(file("P02", "phases"), "P02,1", "a b,1");
    EXPECT_THAT(refusal(), HasSubstr("_phases.csv:2: participant_id: expected 1 to 32 letters "
                                     "(a-z) and digits, found \"a b\""));
    replace(file("P02", "phases"), "a b,1", std::string(33, 'x') + ",1");
    EXPECT_THAT(refusal(), HasSubstr("participant_id: expected 1 to 32"));
    writeLong("P02");
    replace(file("P02", "answers"), "sample", "other");
    EXPECT_THAT(refusal(), HasSubstr("study_id: expected \"sample\" as in the rows before, found "
                                     "\"other\""));
    writeLong("P02");
    fs::copy(file("P02", "answers"), options.study / "sessions" / "copy_answers.csv");
    EXPECT_THAT(refusal(), HasSubstr("row_id: P02-1-1-choice stands in"));
    fs::remove(options.study / "sessions" / "copy_answers.csv");
    writeLong("p01");
    EXPECT_THAT(refusal(), HasSubstr("found both \"P01\" and \"p01\", which differ in capitals"));
    fs::remove(file("p01", "phases"));
    fs::remove(file("p01", "answers"));
    replace(file("P02", "answers"), ",question,choice,", ",vote,choice,");
    EXPECT_THAT(refusal(), HasSubstr("_answers.csv:2: phase: the table of phases has none named "
                                     "\"vote\" of trial 1"));
    writeLong("P02");
    fs::create_symlink("nowhere", options.study / "sessions" / "P9_answers.csv");
    EXPECT_THAT(refusal(), HasSubstr("P9_answers.csv: expected a file, found a folder, or a link"));
    fs::remove(options.study / "sessions" / "P9_answers.csv");
    writeFile(options.study / "dataset_description.json", "[1]");
    EXPECT_THAT(refusal(), HasSubstr("dataset_description.json: expected a JSON object"));
    fs::remove(options.study / "dataset_description.json");
    exportStudy(options);
}

TEST_F(ExportTest, TellsSimulatedFromPeopleAndLeavesRehearsalsOut) {
    PhaseRow row = phase("S01", "question", 10);
    row.trial.simulated = true;
    writeFile(file("S01", "phases"), phaseHeader() + phaseLine(row));
    EXPECT_THAT(refusal(), HasSubstr("1 simulated session(s) among 3 of people"));
    options.simulated = SimulatedRows::exclude;
    EXPECT_EQ(study().sessions.size(), 3u);
    options.simulated = SimulatedRows::include;
    EXPECT_THAT(bidsFiles(study(), false).at("participants.tsv").text,
                HasSubstr("sub-P03\t1\t2\t0\nsub-S01\t1\t1\t1\n"));
    row.trial.rehearsal = true;
    writeFile(file("S01", "phases"), phaseHeader() + phaseLine(row));
    writeFile(file("S02", "phases"), phaseHeader());
    EXPECT_EQ(study().sessions.size(), 3u);
    EXPECT_THAT(study().remarks,
                testing::ElementsAre("1 row(s) of rehearsals were left out",
                                     "1 table(s) without a row were left out: somebody came and "
                                     "left"));
}

TEST_F(ExportTest, ReadsWhatSpreadsheetsAndPeopleWrite) {
    AnswerRow row = answer("P01", "a\t\"quoted\", text\nof lines ", "");
    row.kind = "text";
    writeAnswers("P01", {row});
    const auto before = psychDsFiles(study());
    std::string text = readFile(file("P01", "phases")), crlf = "\xEF\xBB\xBF";
    for (const char c : text)
        crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    writeFile(file("P01", "phases"), crlf);
    writeFile(options.study / "data" / "notes.txt", "not ours");
    EXPECT_EQ(psychDsFiles(study()), before);
    EXPECT_EQ(tableOf(before
                          .at("data/study-sample_subject-P01_session-1_description-answers_data."
                              "csv")
                          .text)[0]["value"],
              row.value);
    EXPECT_THAT(
        bidsFiles(study(), false).at("sub-P01/ses-1/beh/sub-P01_ses-1_task-sample_events.tsv").text,
        HasSubstr("\ta \"quoted\", text of lines \t"));
}

TEST_F(ExportTest, IsWholeOrNotAtAll) {
    options.stimuli = folder_ / "stimuli";
    writeFile(options.stimuli / "b.png", "another picture");
    EXPECT_THAT(refusal(), HasSubstr("_phases.csv:2: files: expected in"));
    for (const char* path : {"../b.png", "/etc/passwd", "a/../b.png"}) {
        writeLong("P01");
        replace(file("P01", "phases"), "b.png", path);
        EXPECT_THAT(refusal(), HasSubstr("expected a file of the stimuli's folder"));
    }
    writeLong("P01");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 2); // study, stimuli
    writeFile(options.stimuli / "b.png", "picture b");
    exportStudy(options);
    EXPECT_EQ(readFile(options.out / "stimuli" / "b.png"), "picture b");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 3);
    EXPECT_THAT(refusal(), HasSubstr("expected the name of something new, or an empty folder"));
    options.out = options.study / "data" / "x";
    EXPECT_THAT(refusal(), HasSubstr("outside the study's folder"));
    options.out = folder_ / "empty";
    fs::create_directory(options.out);
    exportStudy(options);
}

TEST_F(ExportTest, NewPseudonymsAreJoinedByTheKeyAlone) {
    options.key = folder_ / "key.csv";
    for (const char* format : {"bids", "psych-ds", "pwcmp"}) {
        options.format = format;
        options.out = folder_ / format;
        exportStudy(options);
        struct stat status {};
        ASSERT_EQ(::stat(options.key.c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 0777, 0600u);
        const Table key = tableOf(readFile(options.key));
        ASSERT_EQ(key.size(), 3u);
        std::string all;
        for (const auto& entry : fs::recursive_directory_iterator(options.out))
            all += entry.path().string() +
                   (entry.is_regular_file() ? readFile(entry.path()) : std::string());
        for (const auto& line : key) {
            EXPECT_THAT(all, Not(HasSubstr(line.at("participant_id"))));
            EXPECT_THAT(all, HasSubstr(line.at("exported_as") + "-1-1-choice"));
        }
        options.out = folder_ / "again";
        EXPECT_THAT(refusal(), HasSubstr("expected --new-pseudonyms to name a new file"));
        fs::remove(options.key);
    }
    options.key = options.out / "key.csv";
    EXPECT_THAT(refusal(), HasSubstr("outside the export and the study's folder"));
    EXPECT_FALSE(fs::exists(options.out));
}

TEST_F(ExportTest, ComparisonsAreThoseOfPwcmp) {
    writeAnswers("P02", {answer("P02", "2", "a")});
    AnswerRow practice = answer("P03", "1", "b");
    practice.trial.trialKind = "practice";
    writeAnswers("P03", {practice});
    std::vector<std::string> remarks;
    const std::string text = pwcmpFiles(study(), remarks).at("comparisons.csv").text;
    // The columns of pwcmp's example data, video tone mapping, but for its last.
    EXPECT_THAT(text, testing::StartsWith(
                          "observer,session_id,scene,condition_A,condition_B,is_A_selected,"));
    EXPECT_THAT(text, HasSubstr("\nP01,1,atrium,blizzard24,none,1,moderate,c1,choice,"));
    EXPECT_THAT(text, HasSubstr("\nP02,1,atrium,blizzard24,none,0,moderate,c1,choice,"));
    EXPECT_EQ(comparisons().size(), 2u);
}

// Each answer weighs the same, and an undecided one as half for each image.
TEST_F(ExportTest, UndecidedAnswersCountAsHalves) {
    writeAnswers("P02", {answer("P02", "unsure", "")});
    std::map<std::string, std::string> selected;
    for (const auto& line : comparisons())
        selected[line.at("observer")] += line.at("is_A_selected");
    EXPECT_EQ(selected["P01"], "11");
    EXPECT_EQ(selected["P02"], "10");
}

TEST_F(ExportTest, SessionsFromBeforeTheLongTablesAreComparedByTheirRows) {
    fs::remove_all(options.study / "sessions");
    int b = 0;
    for (const auto& line : comparisons())
        b += (line.at("condition_A") == "blizzard24") == (line.at("is_A_selected") == "1");
    EXPECT_EQ(comparisons().size(), 6u);
    EXPECT_EQ(b, 5); // of three in c1 every third chose a, in c2 nobody
}

TEST_F(ExportTest, SaysWhereNothingIsCompared) {
    for (const char* id : {"P01", "P02", "P03"}) {
        AnswerRow row = answer(id, "2>1", "a>b");
        row.kind = "rank";
        writeAnswers(id, {row});
    }
    options.format = "pwcmp";
    EXPECT_THAT(refusal(), HasSubstr("expected choices between two images in main trials"));
}

} // namespace
} // namespace obscura
