# Rscript make_mixed.R FILE: 1000 people answer 100 times; 7 conditions, position, a tendency of each person.
set.seed(3)
people <- 1000
trials <- 100
d <- data.frame(person = rep(seq_len(people), each = trials),
                condition = rep(rep(1:7, length.out = trials), people),
                position = sample(c(-.5, .5), people * trials, TRUE))
effect <- c(0, .3, .7, -.2, 1, -.5, .1)
tendency <- rnorm(people, 0, .8)
d$chosen <- rbinom(nrow(d), 1, plogis(effect[d$condition] + .4 * d$position + tendency[d$person]))
write.csv(d, commandArgs(TRUE)[1], row.names = FALSE, quote = FALSE)
