#include "analysis/verdict.h"

#include "inference/multiplicity.h"

#include <map>

namespace obscura {

std::vector<std::optional<Verdict>> verdictsOf(const std::vector<Tally>& tallies) {
    std::map<std::string, std::vector<std::size_t>> families;
    for (std::size_t i = 0; i < tallies.size(); ++i)
        if (tallies[i].votes.total() > 0)
            families[tallies[i].hypothesis].push_back(i);
    std::vector<std::optional<Verdict>> verdicts(tallies.size());
    for (const auto& [hypothesis, members] : families) {
        std::vector<double> p;
        for (const std::size_t member : members)
            p.push_back(exactP(tallies[member].votes));
        const std::vector<double> adjusted = holm(p), discoveries = benjaminiHochberg(p);
        for (std::size_t i = 0; i < members.size(); ++i)
            verdicts[members[i]] = {adjusted[i], discoveries[i], adjusted[i] < significance};
    }
    return verdicts;
}

} // namespace obscura
