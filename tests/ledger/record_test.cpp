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
  EXPECT_EQ(again.curve, record.curve);
  EXPECT_EQ(again.tests[1].episodes, record.tests[1].episodes);
  EXPECT_EQ(again.provenance.evolution_s, 70.5);
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
