#include "amble/search/cma_es.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/error.hpp"

namespace amble::search {
namespace {

/// Searches the weights of a CPPN with one input and two outputs, so of four weights.
class CmaEsTest : public testing::Test {
 protected:
  CmaEsTest() { neat_.population.size = 12; }
  CmaEs search(std::uint64_t seed = 1) const {
    return CmaEs(settings_, {.neat = neat_, .inputs = 1, .outputs = 2, .seed = seed});
  }
  /// A round by the distance of all weights from 1.
  static double step(CmaEs& search) {
    std::vector<Evaluation> evaluations;
    double best = 0.0;
    for (const neat::Genome& genome : search.ask()) {
      double distance = 0.0;
      for (const neat::LinkGene& link : genome.links) distance += std::pow(link.weight - 1.0, 2);
      evaluations.push_back({1.0 / (1.0 + distance), {}, true});
      best = std::max(best, evaluations.back().objective);
    }
    search.tell(evaluations);
    return best;
  }

  CmaEsSettings settings_;
  neat::Settings neat_;
};

TEST_F(CmaEsTest, FindsTheWeightsThatTheObjectiveWants) {
  CmaEs evolving = search();
  double best = 0.0;
  for (int round = 0; round < 60; ++round) best = step(evolving);
  EXPECT_GT(best, 1.0 - 1e-6);
  EXPECT_EQ(evolving.round(), 60);
}

TEST_F(CmaEsTest, AsksForFullyLinkedGenomesThatNeverGrow) {
  CmaEs evolving = search();
  for (int round = 0; round < 5; ++round) {
    ASSERT_EQ(evolving.ask().size(), 12u);
    for (const neat::Genome& genome : evolving.ask()) {
      EXPECT_NO_THROW(neat::validate(genome, 1, 2, false));
      EXPECT_EQ(genome.links.size(), 4u);
    }
    step(evolving);
  }
}

TEST_F(CmaEsTest, RanksWhatIsNotViableLast) {
  CmaEs evolving = search();
  const auto mean = [&] { return evolving.distribution().mean(); };
  const std::vector<double> before = mean();
  // Only the first half is viable, with the lower objectives: the mean goes to these.
  std::vector<double> expected(before.size(), 0.0);
  std::vector<Evaluation> evaluations;
  for (int i = 0; i < 12; ++i) evaluations.push_back({i < 6 ? 1.0 : 2.0, {}, i < 6});
  std::vector<neat::Genome> asked(evolving.ask().begin(), evolving.ask().end());
  evolving.tell(evaluations);
  for (std::size_t d = 0; d < before.size(); ++d) {
    double least = 1e9, most = -1e9;
    for (int i = 0; i < 6; ++i) {
      least = std::min(least, asked[static_cast<std::size_t>(i)].links[d].weight);
      most = std::max(most, asked[static_cast<std::size_t>(i)].links[d].weight);
    }
    EXPECT_GE(mean()[d], least);
    EXPECT_LE(mean()[d], most);
  }
}

TEST_F(CmaEsTest, GoesOnToTheBitFromACheckpoint) {
  settings_.least_step = 0.01;  // soon reached, so that it begins again before the checkpoint and after it
  const auto restarts = [](const CmaEs& search) { return search.metrics()[2].value; };
  CmaEs evolving = search(7), resumed = search(7);
  for (int round = 0; round < 1000 && restarts(evolving) < 2; ++round) step(evolving);
  for (int round = 0; round < 7; ++round) step(evolving);
  const double before = restarts(evolving);
  ASSERT_EQ(before, 2.0);
  io::BinaryWriter writer;
  evolving.save(writer);
  io::BinaryReader reader(writer.bytes(), "checkpoint");
  resumed.load(reader);
  EXPECT_EQ(resumed.round(), evolving.round());
  for (int round = 0; round < 1000 && restarts(evolving) < before + 2; ++round) {
    ASSERT_EQ(std::vector(evolving.ask().begin(), evolving.ask().end()),
              std::vector(resumed.ask().begin(), resumed.ask().end()));
    step(evolving);
    step(resumed);
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_EQ(evolving.metrics()[i].value, resumed.metrics()[i].value) << evolving.metrics()[i].name;
  }
  EXPECT_EQ(restarts(evolving), before + 2);
}

TEST_F(CmaEsTest, BeginsElsewhereWhenNothingIsLeftToSearch) {
  settings_.least_step = 0.01;
  CmaEs evolving = search();
  for (int round = 0; round < 200; ++round) step(evolving);
  EXPECT_STREQ(evolving.metrics()[2].name.data(), "cma_restarts");
  EXPECT_GT(evolving.metrics()[2].value, 0.0);
  EXPECT_GT(evolving.distribution().widest(), 0.005);
}

TEST_F(CmaEsTest, BeginsElsewhereWhenItGrowsWithoutEnd) {
  CmaEs evolving = search();
  const double most = CmaEs::most_growth * settings_.step;
  double restarts = 0.0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Evaluation> evaluations;
    for (const neat::Genome& genome : evolving.ask()) {
      double objective = 0.0;  // the farther, the better
      for (const neat::LinkGene& link : genome.links) objective += std::log(1.0 + std::abs(link.weight));
      evaluations.push_back({objective, {}, true});
    }
    evolving.tell(evaluations);
    EXPECT_LE(evolving.distribution().widest(), most);
    restarts = evolving.metrics()[2].value;
  }
  EXPECT_GT(restarts, 1.0);
}

TEST_F(CmaEsTest, BeginsElsewhereWhenAllCandidatesOfARoundAreAlike) {
  CmaEs evolving = search();
  const auto tell = [&](const Evaluation& first, const Evaluation& rest) {
    std::vector<Evaluation> evaluations(12, rest);
    evaluations.front() = first;
    evolving.tell(evaluations);
    return evolving.metrics()[2].value;
  };
  EXPECT_EQ(tell({1.0, {}, true}, {1.0, {}, true}), 1.0);
  EXPECT_EQ(tell({1.0, {}, false}, {2.0, {}, false}), 2.0);
  EXPECT_EQ(tell({1.0, {}, true}, {1.0, {}, false}), 2.0);
  EXPECT_EQ(tell({1.5, {}, true}, {1.0, {}, true}), 2.0);
}

TEST_F(CmaEsTest, OfDifferentSeedsSearchesDifferently) {
  EXPECT_NE(search(1).ask()[0], search(2).ask()[0]);
}

TEST_F(CmaEsTest, RefusesAPopulationOfFewerThanFour) {
  neat_.population.size = 3;
  EXPECT_THROW(search(), SettingError);
}

}  // namespace
}  // namespace amble::search
