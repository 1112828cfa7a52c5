# Rscript study.R FILE READER: a part of what obscura-analysis does with the rows of a study of pairs, as one
# would write it in R: read (READER is read.csv or fread, data.table's), check, and the tests of conditions,
# complexity and position. No check of cells, no times, scales, models, figures or report.
arguments <- commandArgs(TRUE)
d <- if (arguments[2] == "fread") as.data.frame(data.table::fread(arguments[1])) else read.csv(arguments[1])

stopifnot(!anyDuplicated(d$row_id),
          !anyDuplicated(d[c("study_id", "participant_id", "session_id", "trial_kind", "condition_id",
                             "repeat_index")]),
          length(unique(d$study_id)) == 1, length(unique(d$design_sha256)) == 1,
          d$chose_b %in% 0:1, d$chosen_position %in% 1:2, d$first_is %in% c("a", "b"),
          d$chose_b == ((d$chosen_position == 2) == (d$first_is == "a")))
d <- d[d$trial_kind == "main" & d$rehearsal == 0, ]

# By condition.
votes <- table(d$condition_id, d$chose_b)
family <- d$hypothesis[match(rownames(votes), d$condition_id)]
test <- function(x, n) {
  tost <- max(pbinom(x - 1, n, .40, lower.tail = FALSE), pbinom(x, n, .60))
  suppressWarnings(c(chi = chisq.test(c(x, n - x))$p.value, exact = binom.test(x, n)$p.value,
                     wilson = prop.test(x, n, correct = FALSE)$conf.int,
                     cp = binom.test(x, n)$conf.int, tost = tost))
}
results <- t(mapply(test, votes[, 2], rowSums(votes)))
holm <- ave(results[, "exact"], family, FUN = function(p) p.adjust(p, "holm"))

# Complexity on the same people: conditions of other levels, each pair; then Cochran's Q of all.
persons <- sort(unique(d$participant_id))
chosen <- matrix(NA_integer_, length(persons), nrow(votes))
chosen[cbind(match(d$participant_id, persons), match(d$condition_id, rownames(votes)))] <- d$chose_b
level <- d$level[match(rownames(votes), d$condition_id)]
groups <- lapply(c("low", "moderate", "high"), function(one) which(level == one))
sets <- do.call(rbind, lapply(seq_len(min(lengths(groups))), function(i) sapply(groups, `[`, i)))
cochran <- function(columns) {
  x <- chosen[, columns]
  k <- ncol(x)
  q <- (k - 1) * (k * sum(colSums(x)^2) - sum(x)^2) / (k * sum(x) - sum(rowSums(x)^2))
  c(q, pchisq(q, k - 1, lower.tail = FALSE))
}
mcnemar <- function(i, j) {
  up <- sum(chosen[, i] < chosen[, j])
  down <- sum(chosen[, i] > chosen[, j])
  binom.test(up, up + down)$p.value
}
q <- apply(sets, 1, cochran)
pairs <- apply(sets, 1, function(s) combn(s, 2, function(two) mcnemar(two[1], two[2])))

# Position: of all votes, by person, within conditions.
second <- d$chosen_position == 2
pooled <- binom.test(sum(second), length(second))$p.value
by_person <- table(d$participant_id, second)
person_p <- p.adjust(apply(by_person, 1, function(x) binom.test(x[2], sum(x))$p.value), "holm")
person_t <- t.test(by_person[, 2] / rowSums(by_person), mu = .5)$p.value
by_place <- table(d$first_is == "a", d$chose_b, d$condition_id)
mantel <- tryCatch(mantelhaen.test(by_place)$p.value, error = function(e) NA)

cat(nrow(d), "votes,", nrow(votes), "conditions,", length(persons), "people; b in", sum(votes[, 2]), "\n")
cat("position p", pooled, person_t, mantel, "; Holm <= .05:", sum(holm <= .05), "conditions,",
    sum(person_p <= .05), "people; Cochran p >=", min(q[2, ]), "\n")
