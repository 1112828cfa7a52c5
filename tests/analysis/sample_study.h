#pragma once

#include "base/files.h"
#include "protocols/reader/manifest.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "tests/protocols/reader/sample_response.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace obscura::test {

inline std::filesystem::path writeRows(const std::filesystem::path& file,
                                       const std::vector<Response>& rows) {
    std::string content = responseHeader();
    for (const Response& row : rows)
        content += responseLine(row);
    writeFile(file, content);
    return file;
}

// As the presenter leaves it: `participants` in two conditions each, one file per person. In "c1"
// every third chooses a, in "c2" nobody does.
inline std::filesystem::path writeStudy(const std::filesystem::path& folder, int participants,
                                        bool simulated = false) {
    for (int number = 1; number <= participants; ++number) {
        Response first = sampleResponse(number, "c1", number % 3 != 0);
        Response second = sampleResponse(number, "c2", true);
        second.level = "high";
        second.trialIndex = 2;
        first.simulated = second.simulated = simulated;
        writeRows(folder / "data" /
                      fmt::format("study-sample_subject-P{:02}_session-1_data.csv", number),
                  {first, second});
    }
    return folder;
}

// The stimuli of that study, "c2" first, and of a condition "c3" that nobody has seen.
inline std::filesystem::path writeStimuli(const std::filesystem::path& folder) {
    Manifest manifest;
    manifest.study = "sample";
    manifest.title = "A sample & its <title>";
    manifest.protocolSha256 = std::string(64, '0');
    manifest.commit = "0123456789ab";
    manifest.width = 64;
    manifest.height = 36;
    for (const auto& [condition, level] :
         {std::pair("c2", "high"), std::pair("c1", "moderate"), std::pair("c3", "moderate")}) {
        ConditionRecord pair;
        pair.condition = condition;
        pair.level = level;
        pair.view = "atrium";
        pair.hypothesis = "H1";
        pair.radius = 0.5;
        pair.image("a").name = "none";
        pair.image("b").name = "blizzard24";
        pair.image("b").meanOcclusion = 0.125;
        pair.image("a").image = {"a.png", std::string(64, 'a')};
        pair.image("b").image = {"b.png", std::string(64, 'b')};
        for (Recipe* recipe : {&pair.image("a").recipe, &pair.image("b").recipe}) {
            recipe->programVersion = "0.1.0";
            recipe->glRenderer = "llvmpipe";
        }
        manifest.conditions.push_back(pair);
    }
    const std::string picture = "\x89PNG, or so we say";
    writeFile(folder / "contact_sheet.png", picture);
    manifest.contactSheets = {{"contact_sheet.png", sha256(picture)}};
    writeManifest(folder / "manifest.json", manifest);
    return folder;
}

} // namespace obscura::test
