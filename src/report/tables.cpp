#include "amble/report/tables.hpp"

#include <fmt/format.h>
#include <span>

#include "amble/core/index.hpp"
#include "amble/ledger/measures.hpp"

namespace amble::report {
namespace {

using Row = std::vector<Cell>;

Cell cell(const std::optional<double>& value) {
  return value ? Cell(*value) : Cell();
}
Cell cell(std::size_t count) {
  return static_cast<std::int64_t>(count);
}

void append(Row& row, const std::optional<statistics::Interval>& interval) {
  row.push_back(interval ? Cell(interval->lower) : Cell());
  row.push_back(interval ? Cell(interval->upper) : Cell());
}

Table runs_table(const Report& report) {
  const auto& study = report.data.study;
  Table table{"runs",
              "one finished run",
              {"condition", "seed", "engine", "generations", "evaluations", "steps", "best_generation"},
              {}};
  const auto measures = measures_of(report.data);
  // Those of maps and tests follow the champion's distance and the sizes of its CPPN.
  table.fixed_columns = table.header.size() + 3;
  table.header.insert(table.header.end(), measures.begin(), measures.end());
  for (const ledger::TestSpec& test : study.tests)
    for (const char* what : {"engine", "trial_s", "gait"}) table.header.push_back(test.name + "." + what);
  for (const char* what : {"digest", "config", "version", "commit", "finished_utc", "evolution_s", "tests_s"})
    table.header.emplace_back(what);
  for (const ledger::Record& run : report.data.records) {
    Row row{run.condition,
            run.seed,
            run.engine,
            std::int64_t{run.generations},
            static_cast<std::int64_t>(run.evaluations),
            static_cast<std::int64_t>(run.steps),
            std::int64_t{run.best_generation}};
    for (const std::string& measure : measures) row.push_back(cell(report.data.value(run, measure)));
    for (const ledger::TestSpec& test : study.tests) {
      const auto* result = report.data.result(run, test.name);
      row.push_back(result ? Cell(result->engine) : Cell());
      row.push_back(result ? Cell(result->trial_s) : Cell());
      row.push_back(result ? Cell(result->gait) : Cell());
    }
    const auto& made = run.provenance;
    for (const std::string& text : {run.digest(), run.config, made.version, made.commit, made.finished_utc})
      row.emplace_back(text);
    row.emplace_back(made.evolution_s);
    row.emplace_back(made.tests_s);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table bests_table(const Report& report) {
  Table table{"bests", "a new best of a run", {"condition", "seed", "generation", "best_m"}, {}};
  for (const ledger::Record& run : report.data.records)
    for (const ledger::CurvePoint& point : run.curve)
      table.rows.push_back({run.condition, run.seed, std::int64_t{point.generation}, point.best_objective});
  return table;
}

Table curves_table(const Report& report) {
  Table table{"curves",
              fmt::format("quartiles over runs of the {} of the champion so far", report.objective.name()),
              {"condition", "generation", "n", "lower_quartile_m", "median_m", "upper_quartile_m"},
              {}};
  for (const BestCurve& curve : report.curves)
    for (std::size_t i = 0; i < curve.generation.size(); ++i)
      table.rows.push_back({curve.condition, std::int64_t{curve.generation[i]}, cell(curve.n),
                            curve.lower_quartile_m[i], curve.median_m[i], curve.upper_quartile_m[i]});
  return table;
}

Table summary_table(const Report& report) {
  Table table{"summary",
              "a measure in a condition; mean with Student’s interval, median and interquartile mean (iqm) "
              "with BCa intervals",
              {"measure", "condition", "n", "planned", "mean", "sd", "mean_lower", "mean_upper", "minimum",
               "lower_quartile", "median", "upper_quartile", "maximum", "iqm", "median_lower", "median_upper",
               "iqm_lower", "iqm_upper"},
              {}};
  for (const SampleSummary& sample : report.summaries) {
    const statistics::Summary& s = sample.summary;
    Row row{sample.measure, sample.condition, cell(s.n), cell(sample.planned), s.mean, cell(s.sd)};
    append(row, s.mean_interval);
    for (const double value :
         {s.minimum, s.lower_quartile, s.median, s.upper_quartile, s.maximum, s.interquartile_mean})
      row.emplace_back(value);
    append(row, sample.median ? std::optional(sample.median->interval) : std::nullopt);
    append(row,
           sample.interquartile_mean ? std::optional(sample.interquartile_mean->interval) : std::nullopt);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table typical_table(const Report& report) {
  Table table{
      "typical",
      "a condition’s champions at a level of disturbance; each champion’s typical (median) distance",
      {"trial_s", "engine", "level", "measure", "condition", "n", "mean_m", "mean_lower", "mean_upper",
       "lower_quartile_m", "median_m", "upper_quartile_m", "median_lower", "median_upper", "fell_share"},
      {}};
  for (const TypicalTable& typical : report.typical)
    for (const TypicalCurve& curve : typical.curves)
      for (const TypicalPoint& point : curve.points) {
        const TypicalTable::Column& column = typical.columns[point.column];
        const statistics::Summary& s = point.summary;
        Row row{typical.trial_s, typical.engine,  std::string(disturbance_name(column)),
                point.measure,   curve.condition, cell(s.n),
                s.mean};
        append(row, s.mean_interval);
        for (const double value : {s.lower_quartile, s.median, s.upper_quartile}) row.emplace_back(value);
        append(row, point.median ? std::optional(point.median->interval) : std::nullopt);
        row.push_back(cell(point.fell_share));
        table.rows.push_back(std::move(row));
      }
  return table;
}

void append(Row& row, const std::optional<AdjustedTest<statistics::TTest>>& test) {
  if (!test) {
    row.resize(row.size() + 7);
    return;
  }
  row.emplace_back(test->test.difference);
  append(row, std::optional(test->test.interval));
  for (const double value : {test->test.t, test->test.degrees_of_freedom, test->test.p, test->p_holm})
    row.emplace_back(value);
}

Table pairs_table(const Report& report) {
  Table table{"pairs",
              "two conditions in one measure; *_holm: adjusted over the measure’s pairs",
              {"measure", "first", "second", "n_first", "n_second"},
              {}};
  for (const std::string test : {"student", "welch"})
    for (const char* what : {"difference", "lower", "upper", "t", "df", "p", "p_holm"})
      table.header.push_back(test + "_" + what);
  for (const char* what : {"u", "mann_whitney_p", "mann_whitney_p_holm", "a12", "a12_lower", "a12_upper"})
    table.header.emplace_back(what);
  for (const PairTable& measure : report.pairs)
    for (const Pair& pair : measure.pairs) {
      Row row{measure.measure, pair.first, pair.second, cell(pair.n_first), cell(pair.n_second)};
      append(row, pair.student);
      append(row, pair.welch);
      const auto& u = pair.mann_whitney;
      row.push_back(u ? Cell(u->test.u1) : Cell());
      row.push_back(u ? Cell(u->test.p) : Cell());
      row.push_back(u ? Cell(u->p_holm) : Cell());
      row.push_back(pair.superiority ? Cell(pair.superiority->a12) : Cell());
      append(row, pair.superiority ? std::optional(pair.superiority->interval) : std::nullopt);
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table survival_table(const Report& report) {
  Table table{
      "survival",
      "a step of a Kaplan–Meier curve",
      {"test", "doing", "condition", "time_s", "at_risk", "ended", "censored", "survival", "lower", "upper"},
      {}};
  for (const SurvivalTable& survival : report.survival)
    for (const ConditionLifetimes& condition : survival.conditions)
      for (const statistics::SurvivalStep& step : condition.curve.steps) {
        Row row{survival.test,       std::string(activity_names[to_index(survival.activity)]),
                condition.condition, step.time_s,
                cell(step.at_risk),  cell(step.ended),
                cell(step.censored), step.survival};
        append(row, step.band);
        table.rows.push_back(std::move(row));
      }
  return table;
}

Table stops_table(const Report& report) {
  Table table{
      "stops",
      "champions of a condition that walk for at least so long by a rule of stopping; those that a claim "
      "counts, with its verdict",
      {"test", "condition", "at_least_s", "claim", "window_s", "radius_m", "runs", "n", "runs_metered",
       "verdict"},
      {}};
  for (const StopCounts& counts : report.stops)
    for (std::size_t i = 0; i < stop_rules.size(); ++i)
      table.rows.push_back(
          {counts.test, counts.condition, counts.at_least_s, counts.claim ? cell(*counts.claim + 1) : Cell(),
           stop_rules[i].window_s, stop_rules[i].radius_m, counts.runs[i] ? cell(*counts.runs[i]) : Cell(),
           cell(counts.n), i == ledger_stop_rule ? cell(counts.metered) : Cell(),
           counts.claim && counts.runs[i] ? Cell(std::string(name_of(counts.verdicts[i]))) : Cell()});
  return table;
}

Table log_rank_table(const Report& report) {
  Table table{"log_rank",
              "how long a condition lasted in a test; the log-rank test is over all its conditions",
              {"test", "doing", "condition", "trial_s", "n", "ended", "expected", "median_s",
               "median_lower_s", "median_upper_s", "chi_square", "df", "p", "exact_p"},
              {}};
  for (const SurvivalTable& survival : report.survival)
    for (std::size_t i = 0; i < survival.conditions.size(); ++i) {
      const ConditionLifetimes& condition = survival.conditions[i];
      const auto& test = survival.log_rank;
      table.rows.push_back({survival.test, std::string(activity_names[to_index(survival.activity)]),
                            condition.condition, survival.trial_s, cell(condition.curve.n),
                            cell(condition.curve.ended), test ? Cell(test->expected[i]) : Cell(),
                            cell(condition.curve.median_s), cell(condition.curve.median_lower_s),
                            cell(condition.curve.median_upper_s), test ? Cell(test->chi_square) : Cell(),
                            test ? cell(test->degrees_of_freedom) : Cell(), test ? Cell(test->p) : Cell(),
                            test ? cell(test->exact_p) : Cell()});
    }
  return table;
}

Table gaits_table(const Report& report) {
  Table table{
      "gaits", "runs of a condition with a gait in a test", {"test", "condition", "gait", "runs", "n"}, {}};
  for (const GaitTable& gaits : report.gaits)
    for (const GaitCounts& counts : gaits.rows)
      for (const auto& [gait, runs] : counts.runs)
        table.rows.push_back({gaits.test, counts.condition, gait, cell(runs), cell(counts.n)});
  return table;
}

Table transfer_table(const Report& report) {
  Table table{"transfer",
              "a condition’s champions in another engine; share: median of distance / reference",
              {"test", "condition", "home", "engine", "trial_s", "n", "median_m", "reference", "n_share",
               "share", "share_lower", "share_upper"},
              {}};
  for (const Transfer& transfer : report.transfers) {
    Row row{transfer.test,          transfer.condition,  transfer.home,     transfer.engine,
            transfer.trial_s,       cell(transfer.n),    transfer.median_m, transfer.reference,
            cell(transfer.n_share), cell(transfer.share)};
    append(row, transfer.share_interval ? std::optional(transfer.share_interval->interval) : std::nullopt);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table mutants_table(const Report& report) {
  Table table{"mutants",
              "a mutant of a run’s champion: its share of the champion’s score, its change of gait",
              {"test", "condition", "seed", "kept", "change"},
              {}};
  for (const ledger::Record& run : report.data.records)
    for (const ledger::TestResult& test : run.tests) {
      if (report.data.result(run, test.name) != &test) continue;
      for (const record::Mutant& mutant : test.mutants)
        table.rows.push_back({test.name, run.condition, run.seed, mutant.kept, mutant.change});
    }
  return table;
}

Table claims_table(const Report& report) {
  Table table{"claims",
              "a claim with its verdict",
              {"claim",    "text",     "source", "figure", "kind",     "measure",       "condition",
               "against",  "verdict",  "reason", "n",      "planned",  "n_against",     "planned_against",
               "quantity", "estimate", "lower",  "upper",  "mean",     "mean_against",  "test",
               "p",        "p_holm",   "alpha",  "ours",   "relation", "p_equivalence", "p_spread"},
              {}};
  for (std::size_t i = 0; i < report.judgements.size(); ++i) {
    const ledger::ClaimSpec& claim = report.data.study.claims[i];
    const Judgement& judgement = report.judgements[i];
    const std::string& against = claim.against.empty() ? claim.base_measure : claim.against;
    Row row{static_cast<std::int64_t>(i + 1),
            claim.text,
            claim.source,
            claim.figure,
            std::string(ledger::claim_kind_names[to_index(claim.kind)]),
            claim.measure,
            claim.condition,
            against.empty() ? claim.threshold_condition : against,
            std::string(name_of(judgement.verdict)),
            judgement.reason,
            cell(judgement.n),
            cell(judgement.planned),
            cell(judgement.n_against),
            cell(judgement.planned_against),
            judgement.quantity,
            cell(judgement.estimate)};
    append(row, judgement.interval);
    for (const auto& value : {judgement.mean, judgement.mean_against}) row.push_back(cell(value));
    row.emplace_back(judgement.test);
    for (const auto& value : {judgement.p, judgement.p_holm}) row.push_back(cell(value));
    row.emplace_back(claim.alpha);
    row.emplace_back(judgement.ours);
    const bool is_difference = claim.kind == ledger::ClaimKind::difference;
    row.push_back(is_difference ? Cell(std::string(ledger::relation_names[to_index(claim.relation)]))
                                : Cell());
    for (const auto& value : {judgement.p_equivalence, judgement.p_spread}) row.push_back(cell(value));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string csv_text(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return quoted(*text);
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *whole);
  return {};
}

}  // namespace

std::vector<Table> tables(const Report& report) {
  std::vector<Table> all{claims_table(report),   runs_table(report),     summary_table(report),
                         pairs_table(report),    curves_table(report),   bests_table(report),
                         survival_table(report), log_rank_table(report), stops_table(report),
                         gaits_table(report),    transfer_table(report), mutants_table(report)};
  if (!report.typical.empty()) all.push_back(typical_table(report));
  return all;
}

std::string to_csv(const Table& table) {
  std::string out = fmt::format("{}\n", fmt::join(table.header, ","));
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) out += (i > 0 ? "," : "") + csv_text(row[i]);
    out += '\n';
  }
  return out;
}

std::string csv_beginning(const Table& table) {
  if (table.fixed_columns == 0) return fmt::format("{}\n", fmt::join(table.header, ","));
  return fmt::format("{},", fmt::join(std::span(table.header).first(table.fixed_columns), ","));
}

}  // namespace amble::report
