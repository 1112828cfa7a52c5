#pragma once

#include <algorithm>
#include <functional>
#include <string>

namespace obscura {

// A part of the work takes the share of the progress line that is planned for it, even if less
// turns out to be needed.
class Effort {
  public:
    using Progress = std::function<void(double done, double total, const std::string& note)>;

    explicit Effort(const Progress& progress) : progress_(progress) {}
    void plan(double cost) { total_ += cost; }
    void begin(double cost, const std::string& note) {
        start_ = done_;
        end_ = start_ + cost;
        note_ = note;
        spend(0);
    }
    void spend(double cost) { tell(std::min(done_ + cost, end_)); }
    void reach(double share) { tell(start_ + share * (end_ - start_)); }
    void end() { tell(end_); }

  private:
    void tell(double done) {
        done_ = done;
        progress_(done_, total_, note_);
    }

    const Progress& progress_;
    std::string note_;
    double start_ = 0, end_ = 0, done_ = 0, total_ = 0;
};

} // namespace obscura
