#include "amble/ledger/record.hpp"

#include <gtest/gtest.h>

#include <string>

#include "amble/core/error.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/ledger/samples.hpp"

namespace amble::ledger {
namespace {

TEST(Record, ReadsBackAsItWasWritten) {
  const Record record = sample_record();
  const std::string text = record_text(record);
  const Record again = parse_record(text, "r.json");
  EXPECT_EQ(record_text(again), text);
  EXPECT_EQ(again.study, record.study);
  EXPECT_EQ(again.condition, record.condition);
  EXPECT_EQ(again.seed, record.seed);
  EXPECT_EQ(again.config, record.config);
  EXPECT_EQ(again.generations, record.generations);
  EXPECT_EQ(again.engine, record.engine);
  EXPECT_EQ(again.evaluations, record.evaluations);
  EXPECT_EQ(again.steps, record.steps);
  EXPECT_EQ(again.best_objective, record.best_objective);
  EXPECT_EQ(again.best_generation, record.best_generation);
  EXPECT_EQ(again.hidden, record.hidden);
  EXPECT_EQ(again.links, record.links);
  EXPECT_EQ(again.curve, record.curve);
  EXPECT_EQ(again.champion, record.champion);
  EXPECT_EQ(again.champion_file, record.champion_file);
}

TEST(Record, ReadsBackHowCommandsWereFollowedAndThatATrialOfLessThanASecondDidNot) {
  Record record = sample_record();
  auto& episodes = record.tests[1].episodes;
  ASSERT_FALSE(episodes.empty());
  episodes.resize(1);
  episodes.push_back(episodes[0]);
  episodes[0].obeyed = {.tracking = 0.5, .speed_error_m_s = 0.125, .turn_error_rad_s = 0.25};
  episodes[1].obeyed = {.tracking = 0.0};
  const Record again = parse_record(record_text(record), "r.json");
  EXPECT_EQ(record_text(again), record_text(record));
  EXPECT_EQ(again.tests[1].obeyed(&Obeyed::tracking), 0.25);
  EXPECT_EQ(again.tests[1].obeyed(&Obeyed::speed_error_m_s), 0.125);
  EXPECT_FALSE(again.tests[0].obeyed(&Obeyed::tracking));
}

/// A record whose second test has two mutants.
Record mutated_record() {
  Record record = sample_record();
  record.tests[1].champion_score = 2.5;
  record.tests[1].mutants = {{.kept = 0.5, .change = 0.125}, {.kept = 1.25, .change = 0.0}};
  return record;
}

TEST(Record, ReadsBackMutants) {
  const Record record = mutated_record();
  EXPECT_NE(record.digest(), sample_record().digest());
  const Record again = parse_record(record_text(record), "r.json");
  EXPECT_TRUE(again.tests[0].mutants.empty());
  EXPECT_EQ(again.tests[1].mutants, record.tests[1].mutants);
  EXPECT_EQ(again.tests[1].champion_score, 2.5);
}

TEST(Record, RefusesMutantsThatCannotBe) {
  const auto refusal = [](const std::string& key, const io::Json& value) {
    auto document = io::parse_json(record_text(mutated_record()), "r.json");
    document["tests"][1]["mutants"][key] = value;
    for (const char* seal : {"checksum", "format", "version"}) document.erase(seal);
    return test::error_of(ExitCode::bad_file, [&] {
      parse_record(io::sealed_json("amble-study-record", 2, document), "r.json");
    });
  };
  EXPECT_NE(refusal("change", {0.5, 0.5, 0.5}).find("as long as 'kept'"), std::string::npos);
  EXPECT_NE(refusal("kept", {0.5, -0.001}).find("at least 0"), std::string::npos);
  EXPECT_NE(refusal("change", {0.5, 1.001}).find("from 0 to 1"), std::string::npos);
  EXPECT_NE(refusal("change", {-0.001, 0.5}).find("from 0 to 1"), std::string::npos);
  EXPECT_NE(refusal("kept", io::Json::array()).find("at least one"), std::string::npos);
}

TEST(Record, ReadsBackTestByTestAndWithItsProvenance) {
  Record record = sample_record();
  record.provenance = {.version = "v",
                       .commit = "c",
                       .compiler = "g++",
                       .flags = "-O2",
                       .cpu = "p",
                       .finished_utc = "2026-01-01T00:00:00Z",
                       .claims = "hash",
                       .evolution_s = 70.5,
                       .tests_s = 3.25,
                       .added_by = {{"noisy", "later"}},
                       .workers = 4};
  const Record again = parse_record(record_text(record), "r.json");
  ASSERT_EQ(again.tests.size(), record.tests.size());
  for (std::size_t i = 0; i < record.tests.size(); ++i) {
    const TestResult &read = again.tests[i], &written = record.tests[i];
    EXPECT_EQ(read.name, written.name);
    EXPECT_EQ(read.settings, written.settings);
    EXPECT_EQ(read.engine, written.engine);
    EXPECT_EQ(read.trial_s, written.trial_s);
    EXPECT_EQ(read.episodes, written.episodes);
    EXPECT_EQ(read.gait, written.gait);
    EXPECT_EQ(read.path_interval_s, written.path_interval_s);
    EXPECT_EQ(read.path_m, written.path_m);
  }
  EXPECT_EQ(again.provenance.version, "v");
  EXPECT_EQ(again.provenance.commit, "c");
  EXPECT_EQ(again.provenance.compiler, "g++");
  EXPECT_EQ(again.provenance.flags, "-O2");
  EXPECT_EQ(again.provenance.cpu, "p");
  EXPECT_EQ(again.provenance.finished_utc, "2026-01-01T00:00:00Z");
  EXPECT_EQ(again.provenance.claims, "hash");
  EXPECT_EQ(again.provenance.evolution_s, 70.5);
  EXPECT_EQ(again.provenance.tests_s, 3.25);
  EXPECT_EQ(again.provenance.workers, 4);
  EXPECT_EQ(again.provenance.added_by, record.provenance.added_by);
}

TEST(Record, DigestIsOfResultsAndNotOfClocksAndMachines) {
  const Record record = sample_record();
  Record elsewhere = record;
  elsewhere.provenance.cpu = "another";
  elsewhere.provenance.finished_utc = "2027-01-01T00:00:00Z";
  elsewhere.provenance.evolution_s = 1.0;
  elsewhere.provenance.commit = "ffff";
  EXPECT_EQ(elsewhere.digest(), record.digest());

  Record other = record;
  other.tests[0].episodes[0].distance_m += 1e-12;
  EXPECT_NE(other.digest(), record.digest());
  other = record;
  other.curve[1].generation = 4;
  EXPECT_NE(other.digest(), record.digest());
  other = record;
  other.champion["genome"] = "there";
  EXPECT_NE(other.digest(), record.digest());
}

TEST(Record, OfFewerThanNoEvaluationsOrStepsIsRefused) {
  for (const bool of_evaluations : {true, false}) {
    Record record = sample_record();
    (of_evaluations ? record.evaluations : record.steps) = std::uint64_t{1} << 63;
    EXPECT_THROW(parse_record(record_text(record), "r.json"), UserError);
    (of_evaluations ? record.evaluations : record.steps) -= 1;
    EXPECT_EQ(parse_record(record_text(record), "r.json").digest(), record.digest());
  }
}

TEST(Record, CutAnywhereIsRefusedWithItsName) {
  const std::string text = record_text(sample_record());
  for (std::size_t length = 0; length + 2 < text.size(); length += 37) {
    try {
      parse_record(text.substr(0, length), "cut.json");
      ADD_FAILURE() << "accepted " << length << " of " << text.size() << " bytes";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_file);
      EXPECT_NE(std::string(error.what()).find("cut.json"), std::string::npos) << error.what();
    }
  }
}

TEST(Record, AlteredIsRefused) {
  std::string text = record_text(sample_record());
  const auto place = text.find("4.25");
  text.replace(place, 4, "9.25");
  EXPECT_THROW(parse_record(text, "r.json"), UserError);
}

TEST(Record, MeasuresOfSeveralEpisodesAreMedians) {
  const Record record = sample_record();
  const TestResult& noisy = record.tests[1];
  EXPECT_EQ(noisy.distance_m(), 3.0);
  EXPECT_EQ(noisy.upright_s(), 9.0);
  EXPECT_EQ(noisy.walking_s(), 9.0);
  EXPECT_FALSE(noisy.upright());
  EXPECT_TRUE(sample_record().tests[0].upright());
}

TEST(Record, BestStaysUntilTheNextPointOfTheCurve) {
  const Record record = sample_record();
  EXPECT_EQ(record.best_after(0), 1.5);
  EXPECT_EQ(record.best_after(2), 1.5);
  EXPECT_EQ(record.best_after(3), 2.0);
  EXPECT_EQ(record.best_after(9), 4.25);
}

}  // namespace
}  // namespace amble::ledger
