#pragma once

#include "base/random.h"
#include "experiment/observer.h"
#include "protocols/reader/manifest.h"
#include "protocols/reader/protocol.h"

#include "inference/thurstone_observer.h"
#include <nlohmann/json_fwd.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What a simulated participant sees: of every image, its predicted JOD with the noise of one look
// (inference/thurstone_observer.h). All questions of a trial about its images are answered by the
// worths that were seen in it, as docs/measurement.md has it in words.
class Eyes {
  public:
    // An Error where the manifest has no predicted JOD of an image that is put in order.
    Eyes(const Protocol& protocol, const Manifest& stimuli, Random random);

    void describe(nlohmann::ordered_json& model) const;
    void look(const Upcoming& trial);
    // The number of the answer's key: of an option or step from 1 (a choice's "not sure" is the
    // last), of the image that is ranked next, or of a slider's tenth from 0. None where the images
    // do not say, or after a lapse. `ranked`: the places that have been given, best first.
    std::optional<int> answer(const Question& question, const std::vector<int>& ranked) const;

  private:
    int choice(const Question& question) const;
    int nextOf(const std::vector<int>& ranked) const;
    std::optional<int> rating(const Question& question) const;

    const Protocol& protocol_;
    std::string display_; // in words
    ThurstoneObserver observer_;
    Random random_;
    std::vector<std::map<std::string, double>> jods_; // of each condition, by role
    std::vector<bool> asksForWorse_;                  // of each condition
    bool triads_;

    // Of the trial.
    bool lapsed_ = false;
    std::vector<double> worths_; // at the places 1, 2 and so on
    std::vector<double> scores_; // there, how much speaks for the image
};

} // namespace obscura
