# Rscript make_study.R PEOPLE CONDITIONS FILE: a study of made-up people in the columns that the presenter
# writes. A person chooses b with probability .6, so that every condition differs from an even split.
arguments <- commandArgs(TRUE)
people <- as.integer(arguments[1])
conditions <- as.integer(arguments[2])
set.seed(1)
hash <- function(letter) strrep(letter, 64)
header <- NULL
for (chunk in split(seq_len(people), (seq_len(people) - 1) %/% 1000)) {
  p <- rep(chunk, each = conditions)
  t <- rep(seq_len(conditions), length(chunk))
  n <- length(p)
  reversed <- (p - 1) %% 14 >= 7
  b <- runif(n) < .6
  first <- ifelse(reversed, "b", "a")
  ms <- function(x) sprintf("%.3f", x)
  level <- c("low", "moderate", "high")[(t - 1) %% 3 + 1]
  rows <- data.frame(
    schema_version = 2, row_id = sprintf("P%06d-1-%d", p, t), study_id = "sample",
    participant_id = sprintf("P%06d", p), session_id = 1, simulated = 0, slot_id = p,
    square_id = (p - 1) %/% 14 + 1, square_row = (p - 1) %% 7 + 1,
    pairs_reversed = as.integer(reversed), trial_index = t, trial_kind = "main", repeat_index = 1,
    condition_id = sprintf("c%d", t), level = level, scene = "atrium",
    hypothesis = sprintf("H%d", (t - 1) %% 2 + 1), technique_a = "none", technique_b = "blizzard24",
    params_a = "{}", params_b = "\"{\"\"radius\"\":0.5,\"\"samples\"\":24}\"",
    stim_first = paste0(first, ".png"), stim_second = ifelse(reversed, "a.png", "b.png"),
    sha256_first = ifelse(reversed, hash("b"), hash("a")),
    sha256_second = ifelse(reversed, hash("a"), hash("b")), first_is = first,
    onset1_ms = ms(t * 1e4), view1_ms = ms(runif(n, 1000, 9000)), mask_frames_planned = 120,
    mask_frames_shown = 120, mask_ms = ms(rnorm(n, 2000, .1)), onset2_ms = ms(t * 1e4 + 6000),
    view2_ms = ms(runif(n, 1000, 9000)), question_onset_ms = ms(t * 1e4 + 9000),
    decision_rt_ms = ms(runif(n, 300, 3000)), refresh_hz = "60.000", missed_frames = 0,
    timestamp_source = "finish", chosen_position = ifelse(b == !reversed, 2, 1),
    chosen_technique = ifelse(b, "blizzard24", "none"), chose_b = as.integer(b), interrupted = 0,
    early_presses_in_mask = 0, app_version = "0.1.0", git_commit = "0123456789ab",
    protocol_sha256 = hash("0"), machine_id = "lab",
    wall_time_utc = sprintf("2026-01-%02dT%02d:%02d:%02dZ", sample(28, n, TRUE), t %% 24, p %% 60, t %% 60),
    rehearsal = 0, design_sha256 = hash("d"))
  write.table(rows, arguments[3], append = !is.null(header), sep = ",", quote = FALSE,
              row.names = FALSE, col.names = is.null(header))
  header <- names(rows)
}
