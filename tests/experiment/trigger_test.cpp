// Real receivers: sockets of this machine, a pseudo-terminal, and, in place of liblsl, a library
// with its functions. Whatever they do, sending returns.
#include "base/error.h"
#include "base/files.h"
#include "experiment/open_trigger.h"
#include "tests/experiment/receiver.h"
#include "tests/experiment/tiny_study.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <pty.h>
#include <termios.h>

#include <array>
#include <ctime>

namespace obscura {
namespace {

using nlohmann::json;

Mark mark(int trial, double age = 0.002) { return {1.5, age, trial, 2, "first-image"}; }

std::string refusal(const std::string& receiver) {
    try {
        openTrigger(receiver);
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

TEST(Trigger, LinesSayWhatCameOnAndWhen) {
    test::Receiver receiver(SOCK_STREAM);
    const auto trigger = openTrigger(receiver.url());
    const std::time_t before = std::time(nullptr);
    trigger->send(mark(3, 0.25));
    const json line = json::parse(receiver.lines(1).at(0));
    EXPECT_EQ(line.size(), 5u);
    EXPECT_EQ(line["onset"], 1.5);
    EXPECT_EQ(line["trial"], 3);
    EXPECT_EQ(line["number"], 2);
    EXPECT_EQ(line["phase"], "first-image");
    const std::string wall = line["wall"];
    std::tm utc{};
    const char* const rest = ::strptime(wall.c_str(), "%Y-%m-%dT%H:%M:%S", &utc);
    ASSERT_NE(rest, nullptr) << wall;
    EXPECT_EQ(std::string(rest).size(), 8u) << wall; // .123456Z
    EXPECT_GE(::timegm(&utc), before - 1) << "a quarter of a second ago";
    EXPECT_LE(::timegm(&utc), std::time(nullptr));
    const auto counts = trigger->counts();
    EXPECT_EQ(counts["sent"], 1);
    EXPECT_EQ(counts["dropped"], 0);
    EXPECT_GE(counts["delay_mean_ms"], 250.0);
    EXPECT_EQ(counts["delay_mean_ms"], counts["delay_max_ms"]);
}

TEST(Trigger, CountsAreOfASession) {
    test::Receiver receiver(SOCK_STREAM);
    const auto trigger = openTrigger(receiver.url());
    trigger->send(mark(1));
    trigger->restart();
    EXPECT_EQ(trigger->counts().dump(),
              R"({"sent":0,"dropped":0,"delay_mean_ms":null,"delay_max_ms":null})");
}

// More than the system keeps for it. What it reads afterwards are whole lines, each that was sent,
// in order.
TEST(Trigger, AReceiverThatStopsReadingCostsItsOwnLinesOnly) {
    test::Receiver receiver(SOCK_STREAM);
    auto trigger = openTrigger(receiver.url());
    int last = 0;
    while (trigger->counts()["dropped"] < 1000)
        trigger->send(mark(++last));
    const auto sent = trigger->counts()["sent"].get<std::size_t>();
    std::vector<std::string> lines = receiver.lines(sent / 2);
    while (trigger->counts()["sent"] == sent)
        trigger->send(mark(++last)); // until there is room again
    trigger.reset();
    for (const std::string& more : receiver.lines(sent)) // to the end
        lines.push_back(more);
    ASSERT_EQ(lines.size(), sent + 1);
    for (std::size_t i = 0; i < sent; ++i)
        ASSERT_EQ(json::parse(lines[i], nullptr, false).value("trial", 0), i + 1) << lines[i];
    EXPECT_EQ(json::parse(lines.back())["trial"], last);
}

TEST(Trigger, AReceiverThatVanishesIsCounted) {
    for (const int type : {SOCK_STREAM, SOCK_DGRAM}) {
        test::Receiver receiver(type);
        const auto trigger = openTrigger(receiver.url());
        trigger->send(mark(1));
        EXPECT_EQ(receiver.lines(1).size(), 1u);
        receiver.vanish();
        for (int i = 0; i < 100; ++i)
            trigger->send(mark(2));
        const auto counts = trigger->counts();
        EXPECT_EQ(counts["sent"].get<int>() + counts["dropped"].get<int>(), 101);
        // The system takes what it is given before it hears that nobody is there.
        EXPECT_LE(counts["sent"], 3) << type;
    }
}

TEST(Trigger, DatagramsArrive) {
    test::Receiver receiver(SOCK_DGRAM);
    const auto trigger = openTrigger(receiver.url());
    for (int i = 1; i <= 20; ++i)
        trigger->send(mark(i));
    const std::vector<std::string> lines = receiver.lines(20);
    for (int i = 1; i <= 20; ++i)
        EXPECT_EQ(json::parse(lines.at(static_cast<std::size_t>(i - 1)))["trial"], i);
}

class Terminal {
  public:
    int master = -1, slave = -1;
    std::string name;

    Terminal() {
        std::array<char, 256> path{};
        EXPECT_EQ(::openpty(&master, &slave, path.data(), nullptr, nullptr), 0);
        name = path.data();
    }
    ~Terminal() {
        ::close(slave);
        if (master >= 0)
            ::close(master);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;
};

TEST(Trigger, ASerialPortGetsTheNumberOfThePhase) {
    const Terminal terminal;
    const auto trigger = openTrigger("serial:" + terminal.name);
    for (const int number : {1, 10, 13, 19, 255, 300}) // of them line ends and XOFF
        trigger->send({1, 0, 1, number, "phase"});
    std::array<unsigned char, 6> bytes{};
    std::size_t got = 0;
    while (got < bytes.size()) {
        const ssize_t size = ::read(terminal.master, bytes.data() + got, bytes.size() - got);
        ASSERT_GT(size, 0);
        got += static_cast<std::size_t>(size);
    }
    EXPECT_EQ(bytes, (std::array<unsigned char, 6>{1, 10, 13, 19, 255, 255}));
    termios settings{};
    ::tcgetattr(terminal.slave, &settings);
    EXPECT_EQ(::cfgetospeed(&settings), static_cast<speed_t>(B115200));
    EXPECT_EQ(trigger->counts()["sent"], 6);
}

TEST(Trigger, ASerialPortThatIsNotReadOrVanishesIsCounted) {
    Terminal terminal;
    const auto trigger = openTrigger("serial:" + terminal.name);
    while (trigger->counts()["dropped"] < 10)
        trigger->send(mark(1));
    trigger->restart();
    ::close(terminal.master);
    terminal.master = -1;
    for (int i = 0; i < 10; ++i)
        trigger->send(mark(1));
    EXPECT_EQ(trigger->counts()["dropped"], 10);
}

TEST(Trigger, WhoIsNotThereIsSaid) {
    std::string tcp, udp;
    {
        const test::Receiver stream(SOCK_STREAM), datagrams(SOCK_DGRAM);
        tcp = stream.url(), udp = datagrams.url();
    }
    EXPECT_NE(refusal(tcp).find("start it before the session"), std::string::npos) << refusal(tcp);
    EXPECT_NE(refusal(udp).find("nobody listens there"), std::string::npos) << refusal(udp);
    EXPECT_NE(refusal("tcp://no.such.host.invalid:5000").find("no.such.host"), std::string::npos);
    EXPECT_NE(refusal("serial:/dev/no-such-port").find("No such file"), std::string::npos);
    EXPECT_NE(refusal("serial:/dev/null").find("no serial port"), std::string::npos);
    EXPECT_NE(refusal("serial:/proc/self/stat").find("--trigger serial:/proc"), std::string::npos);
    for (const char* wrong :
         {"", "tcp", "tcp://", "tcp://host", "tcp://host:0", "tcp://host:65536",
          "tcp://host:", "tcp://:5000", "udp://host:5000/", "http://host:80",
          "serial:", "serial:ttyS0", "LSL", "tcp://host:99999999999999", "tcp://::1:5000"})
        EXPECT_NE(refusal(wrong).find("expected tcp://HOST:PORT"), std::string::npos) << wrong;
}

// A library that is loaded already is found by its name: so openTrigger() finds the one in its
// place.
TEST(Trigger, LabStreamingLayerGetsLinesWithTheTimeOfTheOnset) {
    if (void* real = ::dlopen("liblsl.so", RTLD_NOW); real)
        GTEST_SKIP() << "a real liblsl is installed";
    EXPECT_NE(refusal("lsl").find("liblsl.so was not found"), std::string::npos) << refusal("lsl");

    void* fake = ::dlopen(OBSCURA_FAKE_LSL, RTLD_NOW);
    ASSERT_NE(fake, nullptr) << ::dlerror();
    const auto consumers = reinterpret_cast<void (*)(int)>(::dlsym(fake, "fake_lsl_consumers"));
    const test::TemporaryFolder folder;
    const std::string pushed = (folder.path() / "pushed.txt").string();
    ::setenv("FAKE_LSL", pushed.c_str(), 1);
    {
        const auto trigger = openTrigger("lsl");
        trigger->send(mark(4, 0.25));
        consumers(0); // the recorder has gone
        trigger->send(mark(5));
        EXPECT_EQ(trigger->counts()["sent"], 1);
        EXPECT_EQ(trigger->counts()["dropped"], 1);
        const std::string text = readFile(pushed);
        EXPECT_TRUE(text.starts_with("Obscura Markers 1 0 3 obscura|999.750|{\"onset\": 1.5"))
            << text;
        EXPECT_NE(text.find("\"trial\": 4"), std::string::npos) << text;
    }
    EXPECT_NE(refusal("lsl").find("no recorder has opened the stream"), std::string::npos);
    ::dlclose(fake);
}

} // namespace
} // namespace obscura
