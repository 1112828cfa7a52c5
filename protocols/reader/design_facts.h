#pragma once

#include "protocols/reader/trial.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// What an analysis must know of a study's design (design.h) beyond what stands in its rows.
struct DesignFacts {
    struct Shown {
        std::map<std::string, std::string> techniques; // by role
        std::string correct;                           // the right answer; "" where there is none
    };
    struct Asked {
        Question::Kind kind = Question::Kind::choice;
        bool images = false;             // options are images
        int options = 0, lowest = 1;     // of a scale: how many steps, number of the first
        std::vector<std::string> beside; // images that the same phase shows, by place or role
    };

    std::vector<std::string> order;          // of conditions, the protocol's
    std::map<std::string, Shown> conditions; // by id
    std::vector<std::string> roles;          // put at the places 1, 2 and so on
    std::map<std::string, Asked> questions;  // of trials, by name
    std::string boostReference;              // the role from which images differ more; "" for none
    bool isAdaptive = false;                 // a staircase chose the conditions
};

// An Error names `file` where the text is no design.
DesignFacts designFacts(std::string_view design, const std::string& file);

} // namespace obscura
