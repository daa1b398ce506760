#include "amble/report/page.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/io/quoting.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/page_sections.hpp"
#include "amble/report/report.hpp"
#include "amble/report/tables.hpp"
#include "tests/figures/xml.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

using testing::HasSubstr;
using testing::Not;
using tests::parse_xml;
using tests::with_class;

std::string page(StudyData data) {
  return make_page(make_report(std::move(data)));
}

std::vector<std::string> sections(const std::string& html) {
  std::vector<std::string> found;
  for (const auto& element : parse_xml(html))
    if (element.name == "section") found.push_back(element.attributes.at("id"));
  return found;
}

TEST(Page, IsWellFormedWithTwoConditionsOrTwenty) {
  EXPECT_EQ(sections(page(small_study())),
            (std::vector<std::string>{"claims", "distance", "curves", "survival", "sizes", "gaits",
                                      "transfer", "pairs", "made"}));
  EXPECT_NO_THROW(parse_xml(page(large_study(20, 3))));
  EXPECT_NO_THROW(parse_xml(page(large_study(1, 1))));
}

TEST(Page, HeadsOnlyFiguresThatSomebodyPublished) {
  StudyData data = small_study();
  for (auto& claim : data.study.claims) claim.figure = "none of ours", claim.source = "amble";
  EXPECT_THAT(claims_section(make_report(data)), Not(HasSubstr(">Published</th>")));
  data.study.claims[0].source = "Somebody 2013";
  data.study.claims[0].figure = "9 of 20";
  const std::string mixed = claims_section(make_report(data));
  EXPECT_THAT(mixed, HasSubstr(">Published</th>"));
  EXPECT_THAT(mixed, HasSubstr("9 of 20"));
  EXPECT_THAT(mixed, Not(HasSubstr("of ours")));
}

TEST(Page, ShowsMutantsWhereTestsHaveThem) {
  const std::string html = page(mutated_study());
  EXPECT_EQ(sections(html), (std::vector<std::string>{"claims", "distance", "curves", "survival", "sizes",
                                                      "gaits", "mutants", "transfer", "pairs", "made"}));
  EXPECT_THAT(html, HasSubstr("6 mutants of each champion, in the same trials of 300\u00a0s"));
  EXPECT_THAT(html, HasSubstr("67\u00a0% [67,\u00a067]")) << "four of six are viable in every run of a";
}

TEST(Page, TellsWhichTestsWereAddedLaterByWhichBuild) {
  StudyData data = small_study();
  for (std::size_t i = 0; i < 4; ++i) data.records[i].provenance.added_by["ode"] = "fedcba9876543210+";
  const std::string html = page(data);
  EXPECT_THAT(html, HasSubstr("fedcba987654+"));
  EXPECT_THAT(html, HasSubstr("test ode, added later"));
  EXPECT_THAT(page(small_study()), Not(HasSubstr("added later")));
}

TEST(Page, HasAMatrixOfDifferencesThatIsAntisymmetricAndBoldWhereSignificant) {
  const Report report = make_report(large_study(9, 8));
  std::vector<std::pair<std::string, bool>> expected, found;
  for (const PairTable& table : report.pairs)
    for (int row = 0; row < 9; ++row)
      for (int column = 0; column < 9; ++column) {
        if (row == column) continue;
        const auto name = [](int i) { return "c" + std::to_string(i); };
        const auto& pair = *std::ranges::find_if(table.pairs, [&](const auto& one) {
          return one.first == name(std::min(row, column)) && one.second == name(std::max(row, column));
        });
        const double difference = (row < column ? 1.0 : -1.0) * pair.welch->test.difference;
        expected.emplace_back(number_text(difference, 1), pair.welch->p_holm < 0.05);
      }
  for (const auto& element : parse_xml(pairs_section(report)))
    if (element.name == "span" && std::ranges::count(element.path, "data dense matrix") > 0)
      found.emplace_back(element.text, element.path.back() == "significant");
  EXPECT_EQ(found, expected);
  const auto bold = std::ranges::count(expected, true, &std::pair<std::string, bool>::second);
  EXPECT_GT(bold, 0);
  EXPECT_LT(bold, std::ssize(expected));
}

TEST(Page, NumbersRowsAndColumnsOfAMatrixAlike) {
  std::vector<std::string> heads;
  for (const auto& element : parse_xml(pairs_section(make_report(large_study(9, 3)))))
    if (element.name == "th" && std::ranges::count(element.path, "data dense matrix") > 0)
      heads.push_back(element.text);
  std::vector<std::string> expected{""};
  for (int i = 1; i <= 9; ++i) expected.push_back(std::to_string(i));
  for (int i = 1; i <= 9; ++i) expected.push_back(fmt::format("{} c{}", i, i - 1));
  ASSERT_GE(heads.size(), expected.size());
  for (std::size_t i = 0; i < heads.size(); ++i) EXPECT_EQ(heads[i], expected[i % expected.size()]) << i;
}

TEST(Page, OfAnEmptyLedgerSaysSo) {
  StudyData data = small_study();
  data.records.clear();
  const std::string html = page(data);
  EXPECT_EQ(sections(html), (std::vector<std::string>{"claims", "made"}));
  EXPECT_THAT(html, HasSubstr("0 of 6 runs are in"));
  EXPECT_EQ(count_verdicts(make_report(data).judgements)[to_index(Verdict::not_testable)], 6u)
      << "nothing is testable";
}

TEST(Page, OfAStudyHalfDoneSaysWhatIsThere) {
  StudyData data = small_study();
  data.records.erase(data.records.begin() + 1,
                     data.records.begin() + 5);  // one run of each condition is left
  const std::string html = page(data);
  EXPECT_NO_THROW(parse_xml(html));
  EXPECT_THAT(html, HasSubstr("2 of 6 runs are in (a: 1 of 3; b: 1 of 3)"));
  EXPECT_THAT(html, HasSubstr("too few for any test"));
  EXPECT_THAT(html, HasSubstr("Too few runs: a has 1, 2 are needed."));
}

TEST(Page, SaysWhetherTheClaimsStoodBeforeTheRuns) {
  StudyData data = small_study();
  EXPECT_THAT(page(data), HasSubstr("were the same when each run finished"));
  data.study.claims[0].alpha = 0.01;
  EXPECT_THAT(page(data), Not(HasSubstr("were the same when each run finished")));
  EXPECT_THAT(page(data), HasSubstr("6 of 6 records were made when they were others"));
}

TEST(Page, EscapesHostileTexts) {
  const std::string hostile = "</title><script>alert(1)</script>\"'&<b>\x01";
  StudyData data = small_study();
  data.study.title = data.study.name = hostile;
  data.study.settings = {hostile};
  for (auto& condition : data.study.conditions) condition.title = condition.config = hostile;
  for (auto& claim : data.study.claims) claim.text = claim.source = claim.figure = hostile;
  for (ledger::Record& run : data.records) {
    run.engine = run.config = hostile;
    auto& made = run.provenance;
    made.version = made.commit = made.compiler = made.flags = made.cpu = made.finished_utc = hostile;
    for (auto& test : run.tests) test.gait = test.engine = hostile;
  }
  data.unknown_files = {hostile};
  const std::string html = page(data);
  EXPECT_NO_THROW(parse_xml(html));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("<b>\xEF")));
}

TEST(Page, AsksForNothingAndRunsNothing) {
  const std::string html = page(small_study());
  for (const char* word : {"<script", "http://", "https://", "src=", "url(", "@import", "<link", "<iframe"}) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = html.find(word, at)) != std::string::npos; ++at)
      found += html.compare(at, 18, "http://www.w3.org/") != 0;
    EXPECT_EQ(found, 0u) << word;
  }
}

TEST(Page, ShowsHowLongTheyLastedInTestsLongerThanEvolutionOnly) {
  const std::string html = page(small_study());  // tests of 300 and of 15 s
  std::size_t curves = 0;
  for (std::size_t at = html.find("<h4>Still "); at != std::string::npos;
       at = html.find("<h4>Still ", at + 1))
    ++curves;
  EXPECT_EQ(curves, 2u) << "upright, and walking";
}

TEST(Page, OfAScoreThatIsNoDistanceClaimsNoMetres) {
  const std::string html = page(scored_study("speed_kept"));
  EXPECT_THAT(html, HasSubstr("Score in evolution"));
  EXPECT_THAT(html, HasSubstr("median 5.00 after generation 9"));
  EXPECT_THAT(html, HasSubstr("The score of each run’s champion so far"));
  EXPECT_THAT(html, HasSubstr("5.00 against 1.83; difference 3.17 ["));
  EXPECT_THAT(html, HasSubstr("15.0 m [")) << "of tests";
  for (const char* wrong : {"istance in evolution", "The distance of each run", "How far they walked",
                            "Distance of each run", "generation 9 m", "5.00\u00a0m"})
    EXPECT_THAT(html, Not(HasSubstr(wrong)));
}

TEST(Page, OfConditionsWithSeveralScoresHasTheUnitOfEach) {
  StudyData data = scored_study("speed_kept");
  for (ledger::Record& run : data.records)
    if (run.condition == "a") run.champion.erase("score");
  const std::string html = page(data);
  EXPECT_THAT(html, HasSubstr("a: median 5.00 m after generation 9"));
  EXPECT_THAT(html, HasSubstr("b: median 2.00 after generation 9"));
  EXPECT_THAT(html, HasSubstr("5.00 against 1.83; difference 3.17 ["));
  EXPECT_THAT(html, HasSubstr("Grey: the same champions’ distance in evolution.")) << "of a";
}

TEST(Page, OfAScoreInMetresSaysThatItIsOne) {
  const std::string html = page(scored_study("heading"));
  EXPECT_THAT(html, HasSubstr("Score in evolution, m"));
  EXPECT_THAT(html, HasSubstr("median 5.00 m after generation 9"));
  EXPECT_THAT(html, Not(HasSubstr("istance in evolution")));
}

TEST(Page, RepeatsToTheByte) {
  EXPECT_EQ(page(large_study(4, 5)), page(large_study(4, 5)));
  EXPECT_EQ(to_json(make_report(small_study())), to_json(make_report(small_study())));
}

TEST(Page, HasTheNumbersOfTheTables) {
  const Report report = make_report(large_study(3, 6));
  const std::string html = make_page(report);
  for (const Table& table : tables(report)) {
    if (table.name != "pairs" && table.name != "summary") continue;
    const auto column = [&table](const std::string& title) {
      return static_cast<std::size_t>(std::ranges::find(table.header, title) - table.header.begin());
    };
    const bool pairs = table.name == "pairs";
    const std::string value = pairs ? "welch_difference" : "mean",
                      lower = pairs ? "welch_lower" : "mean_lower",
                      upper = pairs ? "welch_upper" : "mean_upper";
    for (const auto& row : table.rows) {
      const auto number = [&](const std::string& title) { return std::get<double>(row[column(title)]); };
      if (const auto& measure = std::get<std::string>(row[0]); !pairs && !measure.ends_with("_m")) continue;
      const int decimals = decimals_for({number(value), number(lower), number(upper)});
      EXPECT_THAT(
          html, HasSubstr(number_text(number(value), decimals) + " [" + number_text(number(lower), decimals) +
                          ",\u00A0" + number_text(number(upper), decimals) + "]"));
      const std::string p = pairs ? p_number(number("student_p")) : "";
      EXPECT_NE(html.find(io::escape_xml(p)), std::string::npos) << p;
      if (!pairs) continue;
      EXPECT_THAT(html, HasSubstr("<div>" + number_text(number("a12"), 2) + " [" +
                                  number_text(number("a12_lower"), 2) + ", " +
                                  number_text(number("a12_upper"), 2) + "]"));
    }
  }
}

TEST(Page, TellsOfEachConditionWhatItsRunsWereMadeWith) {
  StudyData data = large_study(3, 4);
  for (ledger::Record& run : data.records) {
    const auto condition = static_cast<int>(run.condition.back() - '0');
    run.generations = 10 + 3 * condition;
    run.engine = condition == 1 ? "ode" : "batch";
    run.config = "00f" + std::to_string(condition);
  }
  std::erase_if(data.records, [](const ledger::Record& run) { return run.condition == "c2"; });
  std::vector<std::string> cells;
  bool in_cell = false;
  for (const auto& element : parse_xml(provenance_section(make_report(data)))) {
    const bool head = element.name == "th" && element.attributes.at("scope") == "row";
    if (head || in_cell) cells.push_back(element.text);
    in_cell = element.name == "td";
  }
  const std::vector<std::string> expected{"c0", "c0.toml", "1–4", "4", "10", "batch", "00f0",
                                          "c1", "c1.toml", "1–4", "4", "13", "ode",   "00f1",
                                          "c2", "c2.toml", "1–4", "0", "–",  "–",     "–"};
  ASSERT_GE(cells.size(), expected.size());
  cells.resize(expected.size());
  EXPECT_EQ(cells, expected);
}

TEST(Page, TellsInWhichEnginesAndOnWhatGroundATestWasMade) {
  StudyData data = small_study();
  const auto text = [&data] { return test_text(make_report(data), data.study.tests[0]); };
  EXPECT_EQ(text(), "300 s in the engine batch");
  for (ledger::Record& run : data.records)
    if (run.condition == "b") run.tests[0].engine = "ode";
  EXPECT_EQ(text(), "300 s in the engines batch, ode");
  ledger::TestSpec& test = data.study.tests[0];
  test.episodes = 20;
  test.ground = "../repo/studies/grounds/rough.toml";
  EXPECT_EQ(text(), "300 s in the engines batch, ode, on the ground of rough.toml, 20 episodes (median)");
  test.episodes = 1;
  test.damage = "../repo/configs/damage/limp.toml";
  EXPECT_EQ(text(),
            "300 s in the engines batch, ode, on the ground of rough.toml, with the damage of "
            "configs/damage/limp.toml");
  test.ground = test.damage = "";
  test.noise = "noise.toml";
  EXPECT_EQ(text(),
            "300 s in the engines batch, ode, 1 episode under noise that evolution has not met (median)");
  data.records.clear();
  EXPECT_EQ(text(), "300 s, 1 episode under noise that evolution has not met (median)");
}

TEST(Page, ShowsEachVerdictInTheTableOfClaims) {
  const Report report = make_report(small_study());
  const auto marks = with_class(parse_xml(make_page(report)), "verdict");
  ASSERT_EQ(marks.size(), 5u + 6u) << "five counts, six claims";
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(marks[5 + i].text, name_of(report.judgements[i].verdict));
}

}  // namespace
}  // namespace amble::report
