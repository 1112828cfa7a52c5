#pragma once

#include "viewer/test_mode.h"

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace obscura {

// A test that goes on beside the window, on a thread and in a context of its own.
class TestRun {
  public:
    // `notify` is called, from that thread, whenever the rest gives something else.
    TestRun(TestPlan plan, std::function<void()> notify);
    ~TestRun(); // stops it

    void stop() { stopping_ = true; }
    bool finished() const { return finished_; }
    double share() const { return share_; } // done, 0 ... 1
    std::string now() const;                // "round 1 of 3: nave, gtao"
    // Once finished: the Leeds table, or what went wrong.
    std::string outcome() const;
    bool failed() const { return failed_; }

  private:
    void run(const TestPlan& plan, const std::function<void()>& notify);

    std::atomic<bool> stopping_ = false, finished_ = false, failed_ = false;
    std::atomic<double> share_ = 0;
    mutable std::mutex mutex_;
    std::string now_, outcome_;
    std::thread thread_; // last: it uses all of the above
};

} // namespace obscura
