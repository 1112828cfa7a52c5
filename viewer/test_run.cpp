#include "viewer/test_run.h"

#include <exception>
#include <utility>

namespace obscura {

TestRun::TestRun(TestPlan plan, std::function<void()> notify)
    : thread_([this, kept = std::move(plan), tell = std::move(notify)] { run(kept, tell); }) {}

TestRun::~TestRun() {
    stopping_ = true;
    thread_.join();
}

void TestRun::run(const TestPlan& plan, const std::function<void()>& notify) {
    std::string outcome;
    try {
        const auto rows = runTest(plan, [&](double share, const std::string& now) {
            share_ = share;
            {
                const std::lock_guard lock(mutex_);
                now_ = now;
            }
            notify();
            return !stopping_;
        });
        outcome = leedsTable(plan, rows);
    } catch (const std::exception& problem) { // the window shows it
        outcome = problem.what();
        failed_ = true;
    }
    {
        const std::lock_guard lock(mutex_);
        outcome_ = std::move(outcome);
    }
    finished_ = true;
    notify();
}

std::string TestRun::now() const {
    const std::lock_guard lock(mutex_);
    return now_;
}

std::string TestRun::outcome() const {
    const std::lock_guard lock(mutex_);
    return outcome_;
}

} // namespace obscura
