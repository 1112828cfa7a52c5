#include "analysis/starters.h"

#include <fmt/format.h>

#include <string_view>

namespace obscura {

namespace {

// As a string of R and of Python.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += '\\';
        result += c;
    }
    return result + "\"";
}

constexpr std::string_view r =
    R"(# The results of this study in R: Rscript start.R, or source("start.R", chdir = TRUE).
file <- sub("^--file=", "", grep("^--file=", commandArgs(), value = TRUE))
folder <- if (length(file) == 1) dirname(file) else "."
path <- function(name) if (startsWith(name, "/")) name else file.path(folder, name)
load_table <- function(name)
  read.csv(path(name), na.strings = "", check.names = FALSE, encoding = "UTF-8")

votes <- load_table(@votes@) # a line for each condition
tests <- load_table("tests.csv") # a line for each test beyond single conditions
if (file.exists(path("results.csv"))) results <- load_table("results.csv") # key and value

# The same exact test by R. Conditions without votes have none.
voted <- votes[votes$votes_a + votes$votes_b > 0, ]
p <- mapply(function(b, n) binom.test(b, n)$p.value, voted$votes_b, voted$votes_a + voted$votes_b)
stopifnot(isTRUE(all.equal(unname(p), voted$p_exact, tolerance = 1e-6)))

print(votes[, c("condition_id", "level", "scene", "technique_a", "technique_b", "votes_a",
                "votes_b", "share_b", "p_exact", "p_holm")], row.names = FALSE)
cat(sprintf("%d conditions, %d further tests; p_exact is that of R's binom.test.\n",
            nrow(votes), nrow(tests)))
)";

constexpr std::string_view python =
    R"(# The results of this study in Python: python3 start.py. Tables are lists of dictionaries; with pandas,
# pandas.read_csv gives the same as data frames.
import csv
import math
import pathlib

folder = pathlib.Path(__file__).resolve().parent


def load_table(name):
    with open(folder / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


votes = load_table(@votes@)  # a row for each condition
tests = load_table("tests.csv")  # a row for each test beyond single conditions
if (folder / "results.csv").exists():
    results = load_table("results.csv")  # key and value


def exact_p(a, b):
    """The exact two-sided binomial test of an even split."""
    return min(1, 2 * sum(math.comb(a + b, k) for k in range(min(a, b) + 1)) / 2 ** (a + b))


# The same exact test by Python, where the numbers are small enough.
for row in votes:
    a, b = int(row["votes_a"]), int(row["votes_b"])
    if 0 < a + b < 1000 and not math.isclose(exact_p(a, b), float(row["p_exact"]), rel_tol=1e-6):
        raise SystemExit(f"p_exact of condition {row['condition_id']} is not {exact_p(a, b)}")

columns = ["condition_id", "level", "scene", "technique_a", "technique_b", "votes_a", "votes_b",
           "p_exact", "p_holm"]
for row in votes:
    print("  ".join(row[column] for column in columns))
print(f"{len(votes)} conditions, {len(tests)} further tests; p_exact is that of Python's integers.")
)";

std::string with(std::string_view script, const std::string& votes) {
    constexpr std::string_view place = "@votes@";
    const std::size_t at = script.find(place);
    return fmt::format("{}{}{}", script.substr(0, at), quoted(votes),
                       script.substr(at + place.size()));
}

} // namespace

std::string startR(const std::string& votes) { return with(r, votes); }
std::string startPython(const std::string& votes) { return with(python, votes); }

} // namespace obscura
