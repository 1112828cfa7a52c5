#pragma once

#include "base/tasks.h"
#include "bench/stability/motion.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace obscura {

// Tests in motion as units of work: the truth of a test's frames is one, some configurations in a
// test are one (a frame is drawn, and followed to the next, once for all of them), and at last the
// animation. Results are findings (finding_text.h), of truths the hash of the file that has them.
class MotionTasks {
  public:
    using ResultOf = std::function<std::string(const std::string& unit)>;

    // `mark` ends the names of units.
    MotionTasks(const Motion& motion, const std::vector<std::string>& configurations,
                std::filesystem::path folder, std::string mark);
    ~MotionTasks();

    // Of the stages 0 to 2. They must not outlive this object; `resultOf` gives what units of
    // earlier stages gave.
    std::vector<Task> tasks(const ResultOf& resultOf);
    // The units with cells, in the order of the CSV.
    std::vector<std::string> inOrder() const;
    // Whether the file of truths is there. Others than truths stand.
    bool stands(const std::string& unit, const std::string& result) const;

  private:
    struct Part { // configurations that are drawn together
        std::string name;
        std::vector<NamedSettings> configurations;
    };

    TemporalStudy studyOf(const std::vector<NamedSettings>& configurations) const;
    const TemporalMeasurement& measurement(const Part& part);
    std::string truthsUnit(const std::string& test) const;
    std::filesystem::path truthsFile(const std::string& test) const;
    std::string unitOf(const Part& part, const std::string& test) const;
    std::string animationUnit() const;

    std::string traced(const std::string& test);
    std::vector<Image> truthsOf(const std::string& test) const;
    std::string measured(const Part& part, const std::string& test);
    std::string animated(const ResultOf& resultOf) const;

    const Motion& motion_;
    std::filesystem::path folder_;
    std::string mark_;
    Part truths_; // without configurations
    std::vector<Part> parts_;
    const Part* current_ = nullptr; // what the measurement is of
    std::unique_ptr<TemporalMeasurement> measurement_;
};

} // namespace obscura
