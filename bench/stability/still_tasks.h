#pragma once

#include "base/tasks.h"
#include "bench/measure/tested_technique.h"
#include "bench/stability/failure_test.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace obscura {

// Failure tests of still pictures as units of work: a configuration in a test is one, and so is a
// test's truth. Results are findings (finding_text.h).
class StillTasks {
  public:
    // `mark` ends the names of units.
    StillTasks(std::vector<const FailureTestRow*> tests, std::vector<std::string> configurations,
               ImageSize size, std::filesystem::path folder, std::string mark);

    // In the order of the CSV: first the truths. They must not outlive this object.
    std::vector<Task> tasks();

  private:
    const FailureTest& test(const FailureTestRow& row);
    std::string truth(const FailureTestRow& row);
    std::string measured(const FailureTestRow& row, const std::string& configuration);

    std::vector<const FailureTestRow*> rows_;
    std::vector<std::string> configurations_;
    ImageSize size_;
    std::filesystem::path folder_;
    std::string mark_;
    std::map<const FailureTestRow*, std::unique_ptr<FailureTest>> tests_; // made when first needed
    std::map<std::string, TestedTechnique> tested_;
};

} // namespace obscura
