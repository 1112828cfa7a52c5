#pragma once

#include "matching/match_row.h"

#include <filesystem>
#include <optional>

namespace obscura {

// What matching writes and reads back.

// The techniques as TOML that a protocol can `include`, with their provenance above. No date: equal
// runs give equal bytes.
std::string matchedFragment(const MatchStudy& study, const MatchResult& result);

// One observation a line: technique, view, radius, set, reference, stage, then the errors.
std::string matchTable(const MatchResult& result);

// A finished technique's result, kept under the hash of all that it depends on.
class FinishedTechniques {
  public:
    explicit FinishedTechniques(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // Without `setting`. A file that cannot be read proves nothing, which only costs time.
    std::optional<MatchedTechnique> find(const std::string& key) const;
    void add(const std::string& key, const MatchedTechnique& technique) const;

  private:
    std::filesystem::path path(const std::string& key) const;
    std::filesystem::path folder_;
};

// Root mean squares and means over the test views that a filter takes, views weighing alike.
struct MatchSummary {
    double rmse = 0, bias = 0, biasFree = 0, ssim = 0, meanOcclusion = 0;
    int views = 0;
};
MatchSummary summaryOf(const std::vector<MatchRow>& rows, const std::string& reference,
                       const std::string& stage);

} // namespace obscura
