#include "amble/search/map_elites.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/neat/genome_io.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/search/slow_map.hpp"

namespace amble::search::map_test {

using testing::HasSubstr;

/// What happened while a search and its slow twin were compared.
struct Seen {
  int moved = 0, lost = 0, challenged = 0;
  std::size_t filled = 0;
};

class MapElitesSearch : public testing::TestWithParam<Selection> {
 protected:
  MapElitesSearch() {
    settings_.select = GetParam();
    neat_.mutation.add_node_share = 0.2;
    neat_.mutation.add_link_share = 0.2;
  }

  SearchSpace space() const {
    return {.neat = neat_,
            .inputs = 3,
            .outputs = 2,
            .recurrent = true,
            .seed = 9,
            .behaviour_length = dimensions};
  }
  MapElites make() const { return MapElites(settings_, space()); }

  /// A map of one cell, with random genomes in its first round alone.
  MapElites of_one_cell() {
    settings_.descriptors.assign(1, {});
    settings_.descriptors[0].bins = 1;
    settings_.initial = settings_.batch;
    SearchSpace one = space();
    one.behaviour_length = 1;
    return {settings_, one};
  }

  /// One round; the results in the order of candidates.
  static std::vector<Result> advance(MapElites& search) {
    std::vector<Result> results;
    std::vector<Evaluation> evaluations;
    const auto candidates = search.ask();
    results.reserve(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i)
      results.push_back(result_of(candidates[i], search.round(), i));
    for (const Result& result : results)
      evaluations.push_back(
          {.objective = result.objective, .behaviour = result.descriptor, .viable = result.viable});
    search.tell(evaluations);
    return results;
  }

  static std::string checkpoint(MapElites& search) {
    search.take_log_growth(0);  // written before a checkpoint
    io::BinaryWriter writer;
    search.save(writer);
    return writer.bytes();
  }

  Seen compare_with_twin(int rounds) const {
    MapElites search = make();
    SlowMap twin(settings_);
    Seen seen;
    for (int round = 0; round < rounds; ++round) {
      const std::vector<neat::Genome> candidates(search.ask().begin(), search.ask().end());
      const std::size_t challengers = twin.challengers.size();
      const bool random = round * 40 < 70 || twin.entries.size() + challengers == 0;
      const auto again =
          random ? std::vector<std::uint32_t>() : twin.again(std::min<std::size_t>(10, 40 - challengers));
      EXPECT_EQ(candidates.size(), 40u);
      for (std::size_t i = 0; i < again.size(); ++i)
        EXPECT_EQ(candidates[i], twin.entries.at(again[i]).genome);
      for (std::size_t i = 0; i < challengers; ++i)
        EXPECT_EQ(candidates[again.size() + i], twin.challengers[i].genome);
      const auto results = advance(search);
      for (std::size_t i = 0; i < candidates.size(); ++i)
        if (i < again.size())
          twin.evaluate_again(again[i], candidates[i], results[i]);
        else if (i < again.size() + challengers)
          twin.challenge_again(results[i]);
        else
          twin.enter(candidates[i], results[i]);
      twin.drop_challengers(settings_.most_challengers());
      expect_same(search.elites(), twin, round);
      if (HasFatalFailure()) return seen;
      seen.challenged += static_cast<int>(challengers);
      for (const Metric& metric : search.metrics()) {
        if (metric.name == "moved") seen.moved += static_cast<int>(metric.value);
        if (metric.name == "lost") seen.lost += static_cast<int>(metric.value);
      }
    }
    seen.filled = twin.entries.size();
    return seen;
  }

  void expect_resumption() const {
    MapElites whole = make();
    std::string log = whole.take_log_growth(0);
    std::vector<std::string> checkpoints{checkpoint(whole)};
    std::vector<std::string> logs{log};
    for (int round = 0; round < 12; ++round) {
      advance(whole);
      log += whole.take_log_growth(0);
      logs.push_back(log);
      checkpoints.push_back(checkpoint(whole));
    }
    for (std::size_t from = 0; from < checkpoints.size(); ++from) {
      MapElites other = make();
      advance(other);  // its state is replaced
      io::BinaryReader reader(checkpoints[from], "checkpoint.bin");
      other.load(reader);
      reader.finish();
      io::InputFile file(folder_.put("archive.bin", log));  // ahead of the checkpoint
      EXPECT_EQ(other.restore_log(0, file, "archive.bin"), logs[from].size());
      std::string its_log = logs[from];
      while (other.round() < whole.round()) {
        advance(other);
        its_log += other.take_log_growth(0);
      }
      EXPECT_EQ(its_log, log) << from;
      EXPECT_EQ(checkpoint(other), checkpoints.back()) << from;
      EXPECT_TRUE(std::ranges::equal(other.ask(), whole.ask())) << from;
    }
  }

  static void expect_same(const Elites& elites, const SlowMap& twin, int round) {
    ASSERT_EQ(elites.size(), twin.entries.size()) << round;
    for (const auto& [cell, entry] : twin.entries) {
      const auto number = elites.in(cell);
      ASSERT_NE(number, Elites::none) << round;
      ASSERT_EQ(elites[number].objective, entry.objective);
      ASSERT_EQ(elites[number].evaluations, entry.evaluations);
      ASSERT_EQ(neat::expand(elites[number].genome, ""), entry.genome);
      ASSERT_TRUE(std::ranges::equal(elites.descriptor(number), entry.descriptor));
    }
  }

  MapElitesSettings settings_ = small_map();
  neat::Settings neat_;
  test::TemporaryFolder folder_;
};

TEST_P(MapElitesSearch, KeepsTheElitesOfASlowTwinRoundByRound) {
  settings_.pool.size = 1024;  // a small one is soon full of the lucky alone
  for (const int trials : {1, 2, 3}) {
    settings_.trials = trials;
    const Seen seen = compare_with_twin(trials > 1 ? 200 : 60);  // tried again, fewer enter
    EXPECT_EQ(seen.challenged > 100, trials > 1);
    // Children of the best alone are all of a kind here.
    if (trials > 1 && GetParam() == Selection::objective) continue;
    EXPECT_GT(seen.moved, 10) << "the test should see elites that move";
    EXPECT_GT(seen.lost, 10);
    EXPECT_GE(seen.filled, trials > 1 ? 3u : 20u);
  }
}

TEST_P(MapElitesSearch, GoesOnToTheSameBitsFromACheckpointOfAnyRound) {
  expect_resumption();
  settings_.trials = 3;
  expect_resumption();
}

TEST_P(MapElitesSearch, DrawsParentsAsItsSettingSays) {
  // One row of cells, the objective is the place in it; children are all but their parents.
  settings_.descriptors.assign(1, {});
  settings_.descriptors[0].bins = 50;
  settings_.batch = settings_.initial = 4000;
  settings_.reevaluate_share = 0.0;
  neat_.mutation.add_node_share = neat_.mutation.add_link_share = 0.0;
  neat_.mutation.weights = {.jiggle_limit = 1e-9,
                            .jiggle_many_share = 0.0,
                            .jiggle_few_share = 0.0,
                            .jiggle_one_share = 1.0,
                            .reset_few_share = 0.0,
                            .reset_one_share = 0.0};
  SearchSpace row = space();
  row.behaviour_length = 1;
  MapElites search(settings_, row);
  const auto place = [](const neat::Genome& genome) { return (genome.links[0].weight + 1.5) / 3.0; };
  std::vector<std::vector<float>> descriptors;
  std::vector<Evaluation> evaluations;
  for (const neat::Genome& genome : search.ask()) descriptors.push_back({static_cast<float>(place(genome))});
  for (const auto& descriptor : descriptors)
    evaluations.push_back({.objective = double{descriptor[0]}, .behaviour = descriptor});
  search.tell(evaluations);
  ASSERT_EQ(search.elites().size(), 50u);
  double mean = 0.0;
  for (const neat::Genome& child : search.ask()) mean += place(child) / 4000.0;
  if (GetParam() == Selection::dominated) {
    // The best, and those with the largest gaps above them.
    std::set<double> parents;
    for (const neat::Genome& child : search.ask()) parents.insert(std::round(1e6 * place(child)));
    EXPECT_LE(parents.size(), 3u * 20u);  // jiggling may round to a neighbour
    EXPECT_GE(*parents.rbegin(), 0.99e6);
    return;
  }
  // The larger of two uniform numbers is 2/3 on average; nothing is curious yet. Standard error 0.005.
  EXPECT_NEAR(mean, GetParam() == Selection::objective ? 2.0 / 3.0 : 0.5, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Parents, MapElitesSearch,
                         testing::Values(Selection::uniform, Selection::objective, Selection::curiosity,
                                         Selection::dominated),
                         [](const auto& selection) {
                           return std::string(selection_names[static_cast<std::size_t>(selection.param)]);
                         });

TEST_P(MapElitesSearch, CannotBeEnteredByOneLuckyTrial) {
  // One cell. All genomes are worth the same; one in a hundred evaluations is lucky.
  settings_.descriptors.assign(1, {});
  settings_.descriptors[0].bins = 1;
  SearchSpace one = space();
  one.behaviour_length = 1;
  const std::vector<float> descriptor{0.5f};
  const auto promised = [&](int trials) {
    settings_.trials = trials;
    settings_.reevaluate_share = 0.0;
    MapElites search(settings_, one);
    while (search.round() < 100) {
      std::vector<Evaluation> evaluations;
      for (std::size_t i = 0; i < search.ask().size(); ++i) {
        Stream luck(7, Purpose::test, static_cast<std::uint32_t>(search.round()),
                    static_cast<std::uint32_t>(i));
        evaluations.push_back({.objective = luck.chance(0.01) ? 2.0 : 1.0, .behaviour = descriptor});
      }
      search.tell(evaluations);
    }
    return search.elites().best_objective();
  };
  EXPECT_EQ(promised(1), 2.0);
  EXPECT_LT(promised(8), 1.3);
}

TEST_P(MapElitesSearch, LosesAnEliteWhoseSimulationDiverges) {
  MapElites search = of_one_cell();
  const std::vector<float> descriptor{0.5f};
  const auto tell = [&](double objective_of_the_first, bool is_viable) {
    std::vector<Evaluation> evaluations(search.ask().size(), {.objective = 1.0, .behaviour = descriptor});
    evaluations[0] = {.objective = objective_of_the_first, .behaviour = descriptor, .viable = is_viable};
    search.tell(evaluations);
  };
  tell(5.0, true);
  ASSERT_EQ(search.elites().best_objective(), 5.0);
  tell(5.0, false);  // the elite again
  EXPECT_EQ(search.elites().best_objective(), 1.0) << "another took its place";
}

TEST_P(MapElitesSearch, TakesTheMeanOfAnAngleTheShortWayRound) {
  // The ends of the outer two of four cells are the same angle.
  settings_.descriptors.assign(1, {.quantity = "turn", .leg = "", .least = -180.0, .most = 180.0, .bins = 4});
  settings_.initial = settings_.batch;
  SearchSpace one = space();
  one.behaviour_length = 1;
  for (const bool is_angle : {true, false}) {
    if (is_angle)
      one.circles = {{.lowest = -180.0, .turn = 360.0}};
    else
      one.circles.clear();
    MapElites search(settings_, one);
    for (const float angle : {170.0f, -150.0f}) {
      const std::vector<float> behaviour{angle};
      std::vector<Evaluation> all(search.ask().size(),
                                  {.objective = 1.0, .behaviour = behaviour, .viable = false});
      all[0].viable = true;  // in the second round it is the elite again
      search.tell(all);
    }
    ASSERT_EQ(search.elites().size(), 1u);
    EXPECT_EQ(search.elites().descriptor(0)[0], is_angle ? -170.0f : 10.0f);
    EXPECT_NEAR(search.elites()[0].spread, std::pow((is_angle ? 40.0 : 320.0) / 360.0, 2) / 2.0, 1e-6);
  }
}

TEST_P(MapElitesSearch, TriesAgainFirstWhatIsFarFromTheSeamOfAnAngle) {
  settings_.descriptors.assign(1, {.quantity = "turn", .leg = "", .least = -180.0, .most = 180.0, .bins = 4});
  settings_.trials = 2;
  settings_.challenger_share = 1.0 / settings_.batch;  // one
  SearchSpace one = space();
  one.behaviour_length = 1;
  const auto tries_the_one_at_the_end = [&] {
    MapElites search(settings_, one);
    // At an end, and in the middle of another cell.
    const std::vector<float> end{-179.0f}, middle{-45.0f};
    std::vector<Evaluation> all(search.ask().size(),
                                {.objective = 1.0, .behaviour = middle, .viable = false});
    all[0] = {.objective = 1.0, .behaviour = end, .viable = true};
    all[1].viable = true;
    const neat::Genome first = search.ask()[0], second = search.ask()[1];
    search.tell(all);
    const bool tries_second = std::ranges::find(search.ask(), second) != search.ask().end();
    EXPECT_NE(std::ranges::find(search.ask(), first) != search.ask().end(), tries_second);
    return !tries_second;
  };
  EXPECT_TRUE(tries_the_one_at_the_end()) << "nothing is behind the end of a line";
  one.circles = {{.lowest = -180.0, .turn = 360.0}};
  EXPECT_FALSE(tries_the_one_at_the_end());
  one.circles = {{.lowest = 0.0, .turn = 360.0}};
  EXPECT_TRUE(tries_the_one_at_the_end()) << "the range is not the circle's: its ends hold what is beyond";
}

TEST_P(MapElitesSearch, ThatHasLostAllElitesBeginsWithTheLinksOfItsFirstRound) {
  MapElites search = of_one_cell();
  const std::vector<float> descriptor{0.5f};
  const auto numbers = [&search] {
    std::vector<std::uint64_t> all;
    for (const neat::LinkGene& link : search.ask()[0].links) all.push_back(link.innovation);
    return all;
  };
  const auto first = numbers();
  for (const bool is_viable : {true, true, false})
    search.tell(std::vector<Evaluation>(search.ask().size(),
                                        {.objective = 1.0, .behaviour = descriptor, .viable = is_viable}));
  ASSERT_EQ(search.elites().size(), 0u);
  EXPECT_EQ(numbers(), first);
}

class MapFile : public MapElitesSearch {
 protected:
  void SetUp() override {
    MapElites search = make();
    file_ = search.take_log_growth(0);
    for (int round = 0; round < 4; ++round) {
      advance(search);
      file_ += search.take_log_growth(0);
    }
    checkpoint_ = checkpoint(search);
  }

  /// The message of the UserError; "" if all is well.
  std::string error_of(const std::string& bytes) const {
    MapElites search = make();
    try {
      io::BinaryReader reader(checkpoint_, "checkpoint.bin");
      search.load(reader);
      io::InputFile file(folder_.put("archive.bin", bytes));
      search.restore_log(0, file, "archive.bin");
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_file);
      return error.what();
    }
    return "";
  }

  std::string file_, checkpoint_;
};

TEST_P(MapFile, IsRefusedIfAnyByteOfItIsAltered) {
  EXPECT_EQ(error_of(file_), "");
  for (std::size_t i = 0; i < file_.size(); i += 1 + file_.size() / 200) {
    std::string altered = file_;
    altered[i] = static_cast<char>(altered[i] ^ 16);
    EXPECT_THAT(error_of(altered), HasSubstr("archive.bin: ")) << i;
  }
}

TEST_P(MapFile, IsRefusedWhereverItIsCutOff) {
  for (std::size_t length = 0; length < file_.size(); length += 1 + file_.size() / 100)
    EXPECT_THAT(error_of(file_.substr(0, length)), HasSubstr("archive.bin: ")) << length;
}

TEST_P(MapFile, IsReadUpToItsLastWholeRecordWithoutACheckpoint) {
  io::InputFile whole(folder_.put("archive.bin", file_));
  const Elites elites = read_elites(whole, "archive.bin", bins * bins, dimensions);
  EXPECT_GT(elites.size(), 5u);
  io::InputFile cut(folder_.put("archive.bin", file_.substr(0, file_.size() - 3)));
  EXPECT_GE(read_elites(cut, "archive.bin", bins * bins, dimensions).size() + 1, elites.size());
  io::InputFile other(folder_.put("archive.bin", file_));
  EXPECT_THROW(read_elites(other, "archive.bin", bins, dimensions), UserError);
}

INSTANTIATE_TEST_SUITE_P(Of, MapFile, testing::Values(Selection::curiosity));

/// The message of the UserError that these settings cause; "" if there is none.
std::string refusal(const MapElitesSettings& settings) {
  try {
    settings.validate();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(MapElitesSettings, ThatCannotBeAreRefusedInOneLine) {
  MapElitesSettings settings = small_map();
  EXPECT_EQ(refusal(settings), "");
  settings.descriptors[1].most = 0.0;
  EXPECT_EQ(
      refusal(settings),
      "search.map_elites.descriptors: duty_factor: least = 0, most = 0: expected a range of at least 1e-09");
  settings = small_map();
  settings.descriptors[0].bins = 1'000'000;
  settings.descriptors[1].bins = 1'000'000;
  EXPECT_THAT(refusal(settings), HasSubstr("expected at most 20000000 cells"));
  settings = small_map();
  settings.archive = Archive::cvt;
  settings.centroid_samples = settings.cells - 1;
  EXPECT_THAT(refusal(settings), HasSubstr("centroid_samples = 9999: expected at least"));
  EXPECT_THAT(refusal({}), HasSubstr("expected at least one"));
}

}  // namespace amble::search::map_test
