#include "amble/gait/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "amble/gait/report_text.hpp"
#include "amble/io/json_file.hpp"
#include "tests/figures/golden.hpp"

namespace amble::gait {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Gives each number of a report another value.
class Numbers {
 public:
  double next() { return *given_.insert(++last_ + 0.25).first; }
  std::int64_t count() { return static_cast<std::int64_t>(*given_.insert(++last_).first); }
  PairPhase phase() {
    const double mean = next(), resultant = next();
    return {.phase = mean, .resultant = resultant, .count = count()};
  }
  const std::set<double>& given() const { return given_; }

 private:
  double last_ = 10.0;
  std::set<double> given_;
};

LegGait numbered_leg(const std::string& name, Numbers& numbers) {
  LegGait leg;
  leg.name = name;
  leg.contact_share = numbers.next();
  leg.raw_touchdowns = numbers.count();
  leg.touchdowns = numbers.count();
  leg.strides = numbers.count();
  leg.stride_s = numbers.next();
  leg.stride_sd_s = numbers.next();
  leg.duty_factor = numbers.next();
  leg.phase = numbers.phase();
  leg.drift_strides = numbers.next();
  leg.drift_per_min = numbers.next();
  return leg;
}

/// A report of four legs in which no number is there twice.
Report numbered_report(Numbers& numbers) {
  Report report;
  report.robot = "numbered";
  report.seconds = numbers.next();
  report.settings = {numbers.next(), numbers.next(), numbers.next(), numbers.next()};
  report.classification = Classification{Gait::trot, Irregular::no};
  report.quadruped =
      QuadrupedPhases{numbers.phase(), numbers.phase(), numbers.phase(), numbers.phase(), numbers.next(), {}};
  for (std::size_t gait = 0; gait < gait_names.size(); ++gait)
    report.gait_seconds.push_back(gait_legs[gait] == 4 || gait_legs[gait] == 0 ? numbers.next() : 0.0);
  report.duty_factor = numbers.next();
  report.stride_s = numbers.next();
  report.reference_leg = 2;
  for (const char* name : {"A", "B", "C", "D"}) report.legs.push_back(numbered_leg(name, numbers));
  for (int i = 0; i < 3; ++i)
    report.windows.push_back({.start_s = numbers.next(),
                              .end_s = numbers.next(),
                              .classification = {},
                              .speed_m_s = numbers.next(),
                              .duty_factors = {numbers.next(), numbers.next()},
                              .phases = {numbers.phase()}});
  report.distance_m = numbers.next();
  report.path_m = numbers.next();
  report.speed_m_s = numbers.next();
  report.straightness = numbers.next();
  report.path_speed_m_s = numbers.next();
  report.leg_length_m = numbers.next();
  report.froude = numbers.next();
  report.mass_kg = numbers.next();
  report.work = MotorWork{numbers.next(), numbers.next()};
  report.cost_of_transport_positive = numbers.next();
  report.cost_of_transport_absolute = numbers.next();
  return report;
}

void collect_numbers(const io::Json& json, std::vector<double>& found) {
  if (json.is_number()) found.push_back(json.get<double>());
  if (json.is_structured())
    for (const auto& item : json) collect_numbers(item, found);
}

TEST(GaitReport, HasEachOfItsNumbersInItsJsonOnceAndUnderItsName) {
  Numbers numbers;
  const Report report = numbered_report(numbers);
  const io::Json json = io::parse_json(report_json(report), "text");
  std::vector<double> found, expected(numbers.given().begin(), numbers.given().end());
  collect_numbers(json, found);
  expected.push_back(1.0);  // the version of the format
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
  EXPECT_EQ(json["cost_of_transport_positive"], *report.cost_of_transport_positive);
  EXPECT_EQ(json["cost_of_transport_absolute"], *report.cost_of_transport_absolute);
  EXPECT_EQ(json["work_positive_j"], report.work->positive_j);
  EXPECT_EQ(json["work_absolute_j"], report.work->absolute_j);
  EXPECT_EQ(json["pairs"]["left"]["phase"], report.quadruped->left.phase);
  EXPECT_EQ(json["pairs"]["right"]["phase"], report.quadruped->right.phase);
  EXPECT_EQ(json["pairs"]["hind"]["count"], report.quadruped->hind.count);
  EXPECT_EQ(json["pairs"]["fore"]["resultant"], report.quadruped->fore.resultant);
  EXPECT_EQ(json["legs"][1]["stride_sd_s"], *report.legs[1].stride_sd_s);
  EXPECT_EQ(json["legs"][3]["drift_per_min"], *report.legs[3].drift_per_min);
  EXPECT_EQ(json["reference_leg"], "C");
}

TEST(GaitReport, GoldenTextsMatch) {
  Numbers numbers;
  const Report report = numbered_report(numbers);
  tests::expect_golden({{"gait.json", report_json(report)},
                        {"gait-table.txt", report_table(report)},
                        {"gait-summary.txt", report_summary(report)}},
                       {{"gait-summary.txt", "9263278066c7b8bb"},
                        {"gait-table.txt", "864c1f49eef3cec3"},
                        {"gait.json", "85324cfe6c37910c"}});
}

TEST(GaitReport, NamesEachGaitInItsJson) {
  for (std::size_t gait = 0; gait < gait_names.size(); ++gait) {
    Report report;
    report.classification = Classification{static_cast<Gait>(gait), Irregular::no};
    const io::Json json = io::parse_json(report_json(report), "text");
    EXPECT_EQ(json["gait"], gait_names[gait]);
  }
}

TEST(GaitReport, HasASegmentForEachReasonOfAnIrregularGait) {
  Report report;
  for (const Irregular reason : {Irregular::few_strides, Irregular::mixed_pairs, Irregular::mixed_pairs}) {
    const double start_s = 10.0 * static_cast<double>(report.windows.size());
    report.windows.push_back({.start_s = start_s,
                              .end_s = start_s + 10.0,
                              .classification = Classification{Gait::irregular, reason},
                              .speed_m_s = 0.0,
                              .duty_factors = {},
                              .phases = {}});
  }
  const auto segments = segments_of(report);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].classification, (Classification{Gait::irregular, Irregular::few_strides}));
  EXPECT_EQ(segments[1].classification, (Classification{Gait::irregular, Irregular::mixed_pairs}));
  EXPECT_EQ(segments[0].end_s, 10.0);
  EXPECT_EQ(segments[1].end_s, 30.0);
}

TEST(GaitReport, ListsTheFirstTwelveTimesOfAGaitAndCountsTheOthers) {
  for (int changes = 1; changes <= 40; ++changes) {
    Report report;
    for (int i = 0; i < changes; ++i)
      report.windows.push_back({.start_s = 100.0 + i,
                                .end_s = 101.0 + i,
                                .classification = Classification{i % 2 == 0 ? Gait::trot : Gait::pace, {}},
                                .speed_m_s = 0.0,
                                .duty_factors = {},
                                .phases = {}});
    const std::string table = report_table(report);
    for (int i = 0; i < changes; ++i) {
      const std::string line =
          fmt::format("    {:.1f} … {:.1f} s  {}\n", 100.0 + i, 101.0 + i, i % 2 == 0 ? "trot" : "pace");
      if (changes >= 2 && i < 12)
        EXPECT_THAT(table, HasSubstr(line));
      else
        EXPECT_THAT(table, Not(HasSubstr(line)));
    }
    const std::string rest = fmt::format("and {} more", changes - 12);
    EXPECT_EQ(table.find(rest) != std::string::npos, changes > 12) << table;
  }
}

}  // namespace
}  // namespace amble::gait
