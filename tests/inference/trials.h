#pragma once

#include <vector>

namespace obscura {

// The answers of golden/trials_2afc_28x7.csv: people by conditions, 1 for b.
inline std::vector<std::vector<int>> trialAnswers(const std::vector<std::size_t>& conditions = {
                                                      1, 2, 3, 4, 5, 6, 7}) {
    const char* const people[] = {"0110100", "0011101", "1011111", "1110011", "0110101", "0001100",
                                  "1010101", "1010010", "0101111", "0101110", "1111111", "1111101",
                                  "1011100", "1001100", "0100100", "0000100", "1111001", "1111100",
                                  "1110101", "0110100", "1010111", "0001100", "1011100", "1110111",
                                  "1010110", "1110010", "0110011", "1101111"};
    std::vector<std::vector<int>> answers;
    for (const char* person : people) {
        answers.emplace_back();
        for (const std::size_t condition : conditions)
            answers.back().push_back(person[condition - 1] - '0');
    }
    return answers;
}

} // namespace obscura
