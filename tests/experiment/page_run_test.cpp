#include "base/files.h"
#include "experiment/broken_session.h"
#include "experiment/recorder.h"
#include "experiment/session.h"
#include "experiment/simulated.h"
#include "tests/error_of.h"
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using test::Row;
using testing::HasSubstr;
using testing::Not;

constexpr const char* pages = R"(
[[before]]
name = "about"
questions = [ { name = "age", kind = "number", least = 18, most = 99, optional = true } ]
[[before]]
name = "agreement"
questions = [
  { name = "consent", options = ["first", "second"], endsUnless = ["first"] },
  { name = "name", kind = "text" },
]
[[before]]
name = "welcome"
text = "start"
[[after]]
name = "mood"
questions = [ { name = "mood", kind = "slider", optional = true } ]
)";

// The simulated participant, but on pages around the trials someone who presses these keys.
class Visitor : public SimulatedObserver {
  public:
    Visitor(const Protocol& protocol, std::map<std::string, std::vector<gl::Key>> keys)
        : SimulatedObserver(protocol, 1, "V"), keys_(std::move(keys)) {}

    void preparePage(const Phase& page) override {
        SimulatedObserver::preparePage(page);
        seen.push_back(page.name);
        page_ = page.name;
        next_ = 0;
    }
    void prepare(const Upcoming& trial) override {
        SimulatedObserver::prepare(trial);
        page_.clear();
    }
    double show(const TrialMachine& trial) override {
        return clock_ = std::max(clock_, SimulatedObserver::show(trial));
    }
    const std::vector<Event>& events(bool wait) override {
        const auto keys = keys_.find(page_);
        if (!wait || keys == keys_.end())
            return SimulatedObserver::events(wait);
        const gl::Key key = keys->second.at(next_++);
        clock_ += 1;
        return events_ = {{Event::Kind::press, clock_, key}, {Event::Kind::release, clock_, key}};
    }
    void decline() override { declined = true; }

    bool declined = false;
    std::vector<std::string> seen;

  private:
    std::map<std::string, std::vector<gl::Key>> keys_;
    std::string page_;
    std::size_t next_ = 0;
    double clock_ = 0;
    std::vector<Event> events_;
};

class PageRunTest : public testing::Test {
  protected:
    test::TemporaryFolder folder;
    Study study = [&] {
        const test::TinyStudy tiny = test::writeTinyStudy(folder.path(), {.conditions = ""});
        writeFile(tiny.protocol, readFile(tiny.protocol) + pages);
        return openStudy(tiny.protocol, tiny.stimuli);
    }();
    DataFolder data{folder.path() / "data", study.protocol};
    SessionId session{"V1", 1, false};

    bool run(Visitor& visitor) { return runSession(study, data, session, visitor); }
    std::vector<Row> answers() const { return test::rowsOf(data.answers(session)); }
    std::string journal() const { return readFile(data.journal(session)); }
};

TEST_F(PageRunTest, EachPageIsShownOnceAroundTheTrials) {
    Visitor visitor(study.protocol, {{"about", {gl::Key::enter}}, {"mood", {gl::Key::enter}}});
    ASSERT_TRUE(run(visitor));
    const std::vector<Row> rows = answers();
    ASSERT_EQ(rows.size(), 3u + 7u + 1u);
    EXPECT_EQ(rows[0].at("question"), "age");
    EXPECT_EQ(rows[0].at("value"), "") << "left open";
    EXPECT_EQ(rows[0].at("row_id"), "V1-1-before-age");
    EXPECT_EQ(rows[1].at("value"), "1");
    EXPECT_EQ(rows[2].at("value"), "x");
    EXPECT_EQ(rows[3].at("trial_kind"), "main");
    EXPECT_EQ(rows[10].at("trial_kind"), "after");
    EXPECT_EQ(rows[10].at("trial_index"), "0");
    EXPECT_EQ(rows[10].at("condition_id"), "");
    const std::vector<Row> phases = test::rowsOf(data.phases(session));
    ASSERT_EQ(phases.size(), 3u + 7u * 5u + 1u);
    EXPECT_EQ(phases[2].at("phase"), "welcome");
    EXPECT_EQ(phases[2].at("trial_kind"), "before");
    EXPECT_EQ(Ledger(data.ledger()).records().at(0).state, SlotState::completed);
}

TEST_F(PageRunTest, WithoutConsentNothingButThatIsKept) {
    using Key = gl::Key;
    Visitor visitor(study.protocol,
                    {{"about", {Key::enter}}, {"agreement", {Key::two, Key::down, Key::enter}}});
    // A name is typed, too, which is nobody's business any more.
    study.protocol.before[1].questions[1].optional = true;
    ASSERT_FALSE(run(visitor));
    EXPECT_TRUE(visitor.declined);
    const std::vector<Row> rows = answers();
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].at("question"), "consent");
    EXPECT_EQ(rows[0].at("value"), "2");
    EXPECT_TRUE(test::rowsOf(data.phases(session)).empty());
    EXPECT_THAT(journal(), Not(HasSubstr("\"about\"")));
    EXPECT_THAT(journal(), HasSubstr("ended by the answer to \\\"consent\\\""));
    EXPECT_EQ(Ledger(data.ledger()).records().at(0).state, SlotState::returned);
    EXPECT_THAT(readFile(data.sidecar(session)), HasSubstr("ended by the answer to"));
}

TEST_F(PageRunTest, WhoLeavesBeforeConsentingLeavesNothing) {
    using Key = gl::Key;
    Visitor visitor(study.protocol,
                    {{"about", {Key::enter}}, {"agreement", {Key::escape, Key::two}}});
    ASSERT_FALSE(run(visitor));
    EXPECT_FALSE(visitor.declined);
    EXPECT_TRUE(answers().empty());
    EXPECT_THAT(journal(), Not(HasSubstr("page_finished")));
}

TEST_F(PageRunTest, WhoLeavesAfterTheTrialsHasCompletedThem) {
    Visitor visitor(study.protocol, {{"mood", {gl::Key::escape, gl::Key::two}}});
    ASSERT_TRUE(run(visitor));
    EXPECT_EQ(answers().size(), 3u + 7u);
    EXPECT_EQ(Ledger(data.ledger()).records().at(0).state, SlotState::completed);
}

TEST_F(PageRunTest, WhoGoesOnIsNotAskedAgain) {
    using Key = gl::Key;
    Visitor first(study.protocol, {{"welcome", {Key::escape, Key::two}}});
    ASSERT_FALSE(run(first));
    Visitor second(study.protocol, {});
    ASSERT_TRUE(resumeSession(study, data, brokenSession(study, data, session), second));
    EXPECT_THAT(second.seen, testing::ElementsAre("welcome", "mood"));
    EXPECT_EQ(answers().size(), 3u + 7u + 1u);
}

TEST_F(PageRunTest, WhoDidNotConsentDoesNotGoOn) {
    using Key = gl::Key;
    Visitor visitor(study.protocol, {{"agreement", {Key::two, Key::down, Key::one, Key::enter}}});
    study.protocol.before[1].questions[1].optional = true;
    ASSERT_FALSE(run(visitor));
    EXPECT_THAT(test::errorOf([&] { brokenSession(study, data, session); }),
                HasSubstr("it was ended by the answer to \"consent\""));
}

// A crash between journal and tables: at whatever byte they end.
TEST_F(PageRunTest, TheJournalRestoresPages) {
    Visitor visitor(study.protocol, {});
    ASSERT_TRUE(run(visitor));
    for (const fs::path& path : {data.answers(session), data.phases(session)}) {
        const std::string whole = readFile(path);
        for (std::size_t bytes = whole.find('\n') + 1; bytes < whole.size(); bytes += 97) {
            writeFile(path, whole.substr(0, bytes));
            EXPECT_EQ(restoreTables(data, session), 1);
            ASSERT_EQ(readFile(path), whole) << bytes;
        }
    }
}

} // namespace
} // namespace obscura
