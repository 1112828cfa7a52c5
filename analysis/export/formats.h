#pragma once

#include "analysis/export/study_data.h"
#include "base/new_files.h"

namespace obscura {

// BIDS 1.9.0, behavioural: sub-P01/ses-1/beh/ has _beh.tsv (a line per pair, or per answer where
// trials are no pairs) and _events.tsv (a line per phase and per answer, in seconds); sidecars at
// the root say what the columns mean. With stimuli, images that were shown are named in stim_file,
// and lie in stimuli/.
// https://bids-specification.readthedocs.io/en/v1.9.0/modality-specific-files/behavioral-experiments.html
NewFiles bidsFiles(const RecordedStudy& data, bool withStimuli);

// Those images, from the folder of the study's stimuli. An Error, with its line in the tables, for
// one whose file has another hash than was shown.
NewFiles shownImages(const RecordedStudy& data, const std::filesystem::path& stimuli);

// Psych-DS, with the long tables as data files beside the rows:
// study-..._subject-P01_session-1_description-phases_data.csv, and ...-answers_....
// https://psych-ds.github.io
NewFiles psychDsFiles(const RecordedStudy& data);

// comparisons.csv, one line per choice between two images of main trials: observer, session_id,
// scene, condition_A, condition_B, is_A_selected (pwcmp's example data and pw_scale_table.m,
// https://github.com/mantiuk/pwcmp), then level, condition_id, criterion (the question), row_id.
// Where some answers are "unsure", every answer has two lines: one that is decided twice the same,
// one that is not a line for each image, so that it counts as half a choice of either.
// An Error when the study has no such choices. `remarks`: sentences on what was left out.
NewFiles pwcmpFiles(const RecordedStudy& data, std::vector<std::string>& remarks);

} // namespace obscura
