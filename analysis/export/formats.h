#pragma once

#include "analysis/export/study_data.h"

#include <map>
#include <optional>
#include <string>

namespace obscura {

// The files of an export, by path within its folder.
using ExportFiles = std::map<std::string, std::string>;

// BIDS 1.9.0, behavioural: sub-P01/ses-1/beh/ has _beh.tsv (a line per pair, or per answer where
// trials are no pairs) and _events.tsv (a line per phase and per answer, in seconds); sidecars at
// the root say what the columns mean. `stimuli`: folder of the images; they are compared with the
// hashes in the tables, go into stimuli/, and are named in stim_file.
// https://bids-specification.readthedocs.io/en/v1.9.0/modality-specific-files/behavioral-experiments.html
ExportFiles bidsFiles(const StudyData& data, const std::optional<std::filesystem::path>& stimuli);

// Psych-DS, with the long tables as data files beside the rows:
// study-..._subject-P01_session-1_description-phases_data.csv, and ...-answers_....
// https://psych-ds.github.io
ExportFiles psychDsFiles(const StudyData& data);

// comparisons.csv, one line per choice between two images of main trials: observer, session_id,
// scene, condition_A, condition_B, is_A_selected (pwcmp's example data and pw_scale_table.m,
// https://github.com/mantiuk/pwcmp), then level, condition_id, criterion (the question), row_id.
// Where some answers are "unsure", every answer has two lines: one that is decided twice the same,
// one that is not a line for each image, so that it counts as half a choice of either.
// An Error when the study has no such choices. `remarks`: sentences on what was left out.
ExportFiles pwcmpFiles(const StudyData& data, std::vector<std::string>& remarks);

} // namespace obscura
