# Rscript mixed.R FILE POINTS: the model of mixed_time.cpp by lme4; prints the time of glmer itself.
suppressPackageStartupMessages(library(lme4))
arguments <- commandArgs(TRUE)
d <- read.csv(arguments[1])
d$condition <- factor(d$condition)
time <- system.time(fit <- glmer(chosen ~ 0 + condition + position + (1 | person), d, binomial,
                                 nAGQ = as.integer(arguments[2])))
cat(sprintf("%.3f %.3f %.6f %.6f %.6f\n", time[[1]] + time[[2]], time[[3]], getME(fit, "theta"),
            fixef(fit)[[8]], fixef(fit)[[5]]))
