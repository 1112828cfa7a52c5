#pragma once

#include "base/error.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace obscura {

// One trial as a row: who, what was shown, when, what was answered. Fields are named as their CSV
// columns in camelCase; responseColumns has each column's meaning, and is the only list of them.
struct Response {
    // identity
    int schemaVersion = 2;
    std::string rowId, studyId, participantId, sessionId;
    bool simulated = false;
    int slotId = 0, squareId = 0, squareRow = 0;
    bool pairsReversed = false;
    int trialIndex = 0;
    std::string trialKind = "main";
    int repeatIndex = 1;
    // condition
    std::string conditionId, level, scene, hypothesis, techniqueA, techniqueB, paramsA, paramsB;
    std::string stimFirst, stimSecond, sha256First, sha256Second, firstIs;
    // timing
    double onset1Ms = 0, view1Ms = 0;
    int maskFramesPlanned = 0, maskFramesShown = 0;
    double maskMs = 0, onset2Ms = 0, view2Ms = 0, questionOnsetMs = 0, decisionRtMs = 0;
    double refreshHz = 0;
    int missedFrames = 0;
    std::string timestampSource;
    // answer
    int chosenPosition = 0;
    std::string chosenTechnique;
    bool choseB = false, interrupted = false;
    int earlyPressesInMask = 0;
    // provenance
    std::string appVersion, gitCommit, protocolSha256, machineId, wallTimeUtc;
    // since version 2; in rows of version 1: no rehearsal, and ""
    bool rehearsal = false;
    std::string designSha256;
};

struct Column {
    std::string_view name;        // in the CSV header
    std::string_view description; // for dataset_description.json and readers
    std::variant<std::string Response::*, int Response::*, double Response::*, bool Response::*>
        field;
    std::string_view expected; // "text", "a whole number >= 1", "a or b": checked, and quoted
                               // in errors
    bool (*accepts)(const Response&);
    int since = 1;            // version of the list that brought the column
    bool readsOthers = false; // `accepts` depends on other columns, too
};

// In the order of the file; of an earlier version, those that it had.
std::span<const Column> responseColumns();
std::vector<Column> responseColumns(int version);

// Fields are quoted where they must be (RFC 4180). Both end with a line feed.
std::string responseHeader();
std::string responseLine(const Response& response);

// One row that could not be read, and why.
struct BadRow {
    Place place;
    std::string message;
};

// A part of a file: the records that begin in it, where each line feed of the first is taken for
// the end of a record.
struct FilePart {
    std::int64_t begin = 0; // a byte
    std::int64_t end = std::numeric_limits<std::int64_t>::max();
};

struct ResponseRows {
    int version = 2; // of the file's list of columns
    std::vector<BadRow> bad;
    FilePart read; // whole records
    int lines = 0; // of these
};
struct ResponseFile : ResponseRows {
    std::vector<Response> rows;
    std::vector<int> lines; // of each row, from 1 (the header)
};

// Reads one participant's CSV and checks every row against the columns. A missing or unknown column
// is an Error; but files of an earlier version may lack the columns that came later, and `version`
// says which it is. A bad row is an Error naming file, line and column, or, when `lenient`, goes
// into `bad` and is skipped; so are a last line that is not whole and a header without line feed
// (torn writes). Blank lines are no rows. A place's column is the number of the cell, as a
// spreadsheet shows it.
ResponseFile readResponses(const std::filesystem::path& path, bool lenient);

// The same, but each row is given to `take`, in the memory of the one before: for files of any
// size. Parts can be read at once, for their columns are those of the file's header. What they hold
// is what the file holds if each was read (`read`) up to where the next begins; else a cell goes
// over several lines there. Lines of a part that does not begin the file count from its own first.
ResponseRows eachResponse(const std::filesystem::path& path, bool lenient,
                          const std::function<void(const Response&, int line)>& take,
                          const FilePart& part = {});

} // namespace obscura
