#include "base/process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace obscura {
namespace {

TEST(Process, ThisOneIsThereAndTheSameEachTime) {
    const ProcessId self = ProcessId::current();
    EXPECT_EQ(self.pid, ::getpid());
    EXPECT_EQ(self.boot.size(), 32U);
    EXPECT_GT(self.start, 0);
    EXPECT_EQ(self, ProcessId::current());
    EXPECT_FALSE(isGone(self));
}

TEST(Process, TextGoesThereAndBack) {
    const ProcessId self = ProcessId::current();
    EXPECT_EQ(ProcessId::parse(self.text()), self);
    EXPECT_EQ(self.text().find('/'), std::string::npos);
    for (const char* text :
         {"", ".", "...", "12", "12.5", "x.5..host", "12.x..host", "12.5.zz.host", "-1.5..host",
          "12.5..", "12.5..a b", "12.5..a/b", "12.5..host.png", "12 .5..host"})
        EXPECT_FALSE(ProcessId::parse(text)) << text;
    EXPECT_TRUE(ProcessId::parse("12.5..host"));
}

TEST(Process, EndedOneIsGoneAlsoBeforeAnybodyWaitsForIt) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const std::string name = ProcessId::current().text();
        const bool written =
            ::write(ready[1], name.data(), name.size()) == static_cast<ssize_t>(name.size());
        ::_exit(written ? 0 : 1);
    }
    char text[256];
    const ssize_t length = ::read(ready[0], text, sizeof text);
    ASSERT_GT(length, 0);
    const auto named = ProcessId::parse({text, static_cast<std::size_t>(length)});
    ASSERT_TRUE(named);
    EXPECT_EQ(named->pid, child);
    siginfo_t info{};
    ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT), 0); // a zombie
    EXPECT_TRUE(isGone(*named));
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    EXPECT_TRUE(isGone(*named));
}

TEST(Process, NumberUsedAgainIsAnotherProcess) {
    ProcessId earlier = ProcessId::current();
    --earlier.start;
    EXPECT_TRUE(isGone(earlier));
}

TEST(Process, BeforeTheLastBootIsGone) {
    ProcessId earlier = ProcessId::current();
    earlier.boot[0] = earlier.boot[0] == '0' ? '1' : '0';
    EXPECT_TRUE(isGone(earlier));
}

TEST(Process, InDoubtItIsNotGone) {
    ProcessId elsewhere = ProcessId::current();
    elsewhere.machine += "x";
    elsewhere.pid = 999999999;
    EXPECT_FALSE(isGone(elsewhere));
    ProcessId unknown = ProcessId::current();
    unknown.boot.clear();
    unknown.pid = 999999999;
    EXPECT_FALSE(isGone(unknown));
    ProcessId noStart = ProcessId::current();
    noStart.start = -1;
    EXPECT_FALSE(isGone(noStart));
}

} // namespace
} // namespace obscura
