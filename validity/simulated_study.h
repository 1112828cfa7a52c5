#pragma once

#include "protocols/reader/protocol.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace obscura {

// What is true of simulated people.
struct Truth {
    std::vector<double> shares; // mean share of b, of each of the protocol's conditions
    double spread = 0;          // JOD: standard deviation of people's leanings towards b
    double positionBias = 0;    // added to the probability of choosing the second image
};

// Runs whole studies: orders, trials, the simulated observer and rows are the presenter's, as in a
// session. Bypassed are the window, the ledger, the journal, and the disk: the rows are a text.
class StudySimulator {
  public:
    explicit StudySimulator(Protocol protocol);
    ~StudySimulator();

    // The CSV of all people, from slot 1 on. The same seed gives the same text.
    std::string rows(const Truth& truth, int people, std::uint64_t seed) const;
    const Protocol& protocol() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace obscura
