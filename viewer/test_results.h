#pragma once

#include "protocols/reader/study.h"
#include "viewer/picture.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// What the viewer's test mode (test_mode.h) is to do, and what came of it as texts.

struct TestPlan {
    std::vector<View> cameras; // names that differ; scenes as loadSceneOf() takes them
    std::vector<TechniqueSetting> techniques; // names that differ; radii are the cameras'
    Level level; // `environment`: absolute, or relative to the working folder
    Normals normals = Normals::smooth;
    bool textures = true;
    int width = 1280, height = 720;
    double seconds = 5; // of each technique from each camera in each round; at least 3 frames
    int rounds = 3;
    std::uint64_t seed = 1;       // of the orders
    std::filesystem::path out;    // folder of the results; must not have any yet
    std::filesystem::path scenes; // folder that scene files are in
};

// What one technique from one camera took in one round. Times of parts are means over its frames,
// in milliseconds.
struct TestRow {
    int round = 0, place = 0; // from 1; the place in the order of the round
    std::string camera, technique;
    int frames = 0;
    double seconds = 0; // of these frames together
    double gbufferMs = 0, lightMs = 0;
    std::vector<PassDrawn> passes; // of the technique

    double fps() const { return frames / seconds; }
    double techniqueMs() const;
};

// What times were measured with.
struct TestMachine {
    std::string renderer, processor, timed, program;
};

// A row for each round, camera and technique (test.csv), and one for each pass of those
// (passes.csv).
std::string testCsv(const TestPlan& plan, const TestMachine& machine,
                    const std::vector<TestRow>& rows);
std::string passesCsv(const std::vector<TestRow>& rows);

// Table 1 of the Leeds thesis: for each camera the mean of the rounds' frames per second with each
// technique, and the average over the cameras. Without rows, a sentence that says so.
std::string leedsTable(const TestPlan& plan, const std::vector<TestRow>& rows);

} // namespace obscura
