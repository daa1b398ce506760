#include "amble/search/dominated_pool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"

namespace amble::search {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

constexpr double endless = std::numeric_limits<double>::infinity();

PoolMember member(double objective, std::vector<double> descriptor) {
  return {.genome = std::to_string(objective), .objective = objective, .descriptor = std::move(descriptor)};
}

std::vector<double> objectives(const DominatedPool& pool) {
  std::vector<double> all;
  for (const PoolMember& one : pool.members()) all.push_back(one.objective);
  return all;
}

TEST(DominatedNovelty, IsTheMeanDistanceToTheNearestThatAreBetter) {
  const std::vector<PoolMember> members{member(3.0, {0.0}), member(2.0, {0.5}), member(1.0, {0.2}),
                                        member(0.0, {1.0})};
  EXPECT_THAT(dominated_novelty(members, 2),
              ElementsAre(endless, DoubleEq(0.5), DoubleEq((0.2 + 0.3) / 2.0), DoubleEq((0.5 + 0.8) / 2.0)));
  EXPECT_THAT(dominated_novelty(members, 1),
              ElementsAre(endless, DoubleEq(0.5), DoubleEq(0.2), DoubleEq(0.5)));
}

TEST(DominatedNovelty, CountsTheDistanceOverAllDimensions) {
  EXPECT_THAT(dominated_novelty(std::vector{member(1.0, {0.0, 0.0}), member(0.0, {0.3, 0.4})}, 3),
              ElementsAre(endless, DoubleEq(0.5)));
}

TEST(DominatedNovelty, OfEquallyGoodOnesTheFirstCountsAsBetter) {
  EXPECT_THAT(dominated_novelty(std::vector{member(1.0, {0.0}), member(1.0, {0.25})}, 3),
              ElementsAre(endless, DoubleEq(0.25)));
}

TEST(DominatedNovelty, IsWhatLookingAtAllDistancesGives) {
  Stream stream(1, Purpose::test);
  std::vector<PoolMember> members;
  for (int i = 0; i < 60; ++i)
    members.push_back(member(std::floor(10.0 * stream.uniform()), {stream.uniform(), stream.uniform()}));
  const std::vector<double> novelties = dominated_novelty(members, 4);
  for (std::size_t i = 0; i < members.size(); ++i) {
    std::vector<double> distances;
    for (std::size_t j = 0; j < members.size(); ++j)
      if (members[j].objective > members[i].objective ||
          (members[j].objective == members[i].objective && j < i))
        distances.push_back(std::hypot(members[i].descriptor[0] - members[j].descriptor[0],
                                       members[i].descriptor[1] - members[j].descriptor[1]));
    std::ranges::sort(distances);
    distances.resize(std::min<std::size_t>(4, distances.size()));
    double sum = 0.0;
    for (const double distance : distances) sum += distance;
    if (distances.empty()) {
      EXPECT_EQ(novelties[i], endless);
      continue;
    }
    EXPECT_NEAR(novelties[i], sum / static_cast<double>(distances.size()), 1e-12);
  }
}

TEST(DominatedNovelty, OfAnAngleIsTheDistanceTheShortWayRound) {
  const std::vector members{member(1.0, {0.0, 0.05}), member(0.0, {0.0, 0.95})};
  EXPECT_NEAR(dominated_novelty(members, 1)[1], 0.9, 1e-12);
  EXPECT_NEAR(dominated_novelty(members, 1, std::vector{0.0, 1.0})[1], 0.1, 1e-12);
}

TEST(DominatedPool, KeepsTheBestAndWhatIsUnlikeAllBetterOnes) {
  DominatedPool pool(2, 3);
  pool.add({member(3.0, {0.5}), member(2.9, {0.51}), member(0.1, {0.9})});
  EXPECT_THAT(objectives(pool), ElementsAre(3.0, 0.1));
  pool.add({member(4.0, {0.52})});  // the one at 0.5 is now in its shade
  EXPECT_THAT(objectives(pool), ElementsAre(4.0, 0.1));
}

TEST(DominatedPool, KeepsOneOfTwoTwinsThatAreTheBest) {
  DominatedPool pool(2, 3);
  pool.add({member(3.0, {0.5}), member(3.0, {0.5}), member(1.0, {0.1})});
  EXPECT_THAT(objectives(pool), ElementsAre(3.0, 1.0));
}

TEST(DominatedPool, IsReadAsItWasSaved) {
  DominatedPool pool(3, 3), again(3, 3);
  pool.add({member(3.0, {0.5, 0.1}), member(2.9, {0.51, 0.1}), member(0.1, {0.9, 0.1})});
  io::BinaryWriter writer;
  pool.save(writer);
  io::BinaryReader reader(writer.bytes(), "the checkpoint");
  again.load(reader, 2);
  ASSERT_EQ(again.members().size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.members()[i].genome, pool.members()[i].genome);
    EXPECT_EQ(again.members()[i].objective, pool.members()[i].objective);
    EXPECT_EQ(again.members()[i].descriptor, pool.members()[i].descriptor);
  }
}

TEST(DominatedPool, RefusesWhatBelongsToAnotherPool) {
  DominatedPool pool(3, 3), smaller(2, 3), same(3, 3);
  pool.add({member(3.0, {0.5}), member(2.9, {0.51}), member(0.1, {0.9})});
  io::BinaryWriter writer;
  pool.save(writer);
  io::BinaryReader reader(writer.bytes(), "the checkpoint"), other(writer.bytes(), "the checkpoint");
  EXPECT_THROW(smaller.load(reader, 1), UserError);
  EXPECT_THROW(same.load(other, 2), UserError);
}

}  // namespace
}  // namespace amble::search
