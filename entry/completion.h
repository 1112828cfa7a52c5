#pragma once

#include "base/argument_table.h"

#include <string>
#include <vector>

namespace obscura {

// What may stand next on a command line.
struct Completion {
    struct Word {
        std::string text, about;
        bool operator==(const Word&) const = default;
    };
    std::vector<Word> words;
    std::string also; // "files", "folders", or "nothing": what the shell itself can find besides
};

// Of a program with these arguments, after its name: `words` as they stand, the last one up to the
// cursor, perhaps "". Bash gives "--level=hi" as three words, zsh as one; either is understood.
// `protocols` are the names of those that come with the programs.
Completion completionOf(const std::vector<Argument>& program, std::vector<std::string> words,
                        const std::vector<std::string>& protocols);

} // namespace obscura
