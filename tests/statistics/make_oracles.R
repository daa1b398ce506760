# The part of make_oracles that R computes: reads survival data, writes one line per number.
#   Rscript make_oracles.R LIFETIMES.csv P_VALUES.csv TABLES.csv
# Output: kind,set,name,index,value with 17 digits, NA where R has no value.
suppressPackageStartupMessages(library(survival))
args <- commandArgs(trailingOnly = TRUE)

out <- function(kind, set, name, values) {
  values <- as.numeric(values)
  text <- ifelse(is.na(values), "NA", sprintf("%.17g", values))
  cat(sprintf("%s,%s,%s,%d,%s\n", kind, set, name, seq_along(values) - 1, text), sep = "")
}

lifetimes <- read.csv(args[1])
for (set in unique(lifetimes$set)) {
  data <- lifetimes[lifetimes$set == set, ]
  for (group in sort(unique(data$group))) {
    one <- data[data$group == group, ]
    curve <- paste(set, group, sep = "/")
    for (type in c("log", "log-log")) {
      fit <- survfit(Surv(time_s, ended) ~ 1, data = one, conf.type = type)
      steps <- summary(fit, censored = TRUE)
      tag <- ifelse(type == "log", "log", "log_log")
      out("curve", curve, paste0(tag, "_lower"), steps$lower)
      out("curve", curve, paste0(tag, "_upper"), steps$upper)
      middle <- summary(fit)$table
      out("curve", curve, paste0(tag, "_median"), middle[c("median", "0.95LCL", "0.95UCL")])
    }
    out("curve", curve, "time_s", steps$time)
    out("curve", curve, "at_risk", steps$n.risk)
    out("curve", curve, "ended", steps$n.event)
    out("curve", curve, "survival", steps$surv)
    out("curve", curve, "standard_error", steps$std.err)
  }
  if (length(unique(data$group)) < 2 || sum(data$ended) == 0) next
  # All end at the first time: survdiff would invert a matrix of zeros.
  if (length(unique(data$time_s)) == 1 && all(data$ended == 1)) next
  test <- survdiff(Surv(time_s, ended) ~ group, data = data, rho = 0)
  df <- sum(test$exp > 0) - 1
  if (df < 1) next
  out("log_rank", set, "chi_square", test$chisq)
  out("log_rank", set, "degrees_of_freedom", df)
  out("log_rank", set, "p", pchisq(test$chisq, df, lower.tail = FALSE))
  out("log_rank", set, "observed", test$obs)
  out("log_rank", set, "expected", test$exp)
}

p_values <- read.csv(args[2])
for (set in unique(p_values$set))
  out("holm", set, "adjusted", p.adjust(p_values$p[p_values$set == set], method = "holm"))

tables <- read.csv(args[3])
for (i in seq_len(nrow(tables))) {
  row <- tables[i, ]
  counts <- matrix(c(row$k1, row$n1 - row$k1, row$k2, row$n2 - row$k2), nrow = 2, byrow = TRUE)
  out("fisher", row$set, "p", fisher.test(counts)$p.value)
  if (row$n1 > 0) out("fisher", row$set, "clopper_pearson", binom.test(row$k1, row$n1)$conf.int)
}
