#include "amble/neat/settings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

TEST(Settings, DefaultsAreThePublishedNumbers) {
  const Settings s;
  EXPECT_NO_THROW(s.validate());
  EXPECT_EQ(s.population.size, 300);
  EXPECT_EQ(s.mutation.add_link_share, 0.06);
  EXPECT_EQ(s.mutation.add_node_share, 0.01);
  EXPECT_EQ(s.reproduction.elitism, 0.1);
}

TEST(Settings, AllFieldsAreVisited) {
  // Every number is changed through the visitor's JSON, and every one arrives.
  io::Json json = io::settings_to_json(Settings{});
  int leaves = 0;
  const std::function<void(io::Json&)> change = [&](io::Json& node) {
    for (auto& [key, value] : node.items()) {
      if (value.is_object()) {
        change(value);
        continue;
      }
      ++leaves;
      if (value.is_boolean())
        value = !value.get<bool>();
      else if (value.is_number_integer())
        value = value.get<int>() + 1;
      else if (value.is_number())
        value = value.get<double>() / 2;
    }
  };
  change(json);
  json["genome"]["output_activation"] = "sine";
  json["mutation"]["split_link"] = "disable";
  json["innovations"]["scope"] = "run";
  json["innovations"]["key"] = "link_and_function";
  json["reproduction"]["lone_place"] = "elite";
  json["crossover"]["weaker_genes"] = "one_by_one";
  const auto read = io::settings_from_json<Settings>(io::JsonView(json, "settings"));
  EXPECT_EQ(io::settings_to_json(read), json);
  EXPECT_EQ(leaves, 1 + 7 + 14 + 2 + 4 + 10 + 7);
  EXPECT_EQ(read.population.size, 301);
  EXPECT_EQ(read.genome.activation_shares[3], 0.125);
  EXPECT_EQ(read.genome.output_activation, Activation::sine);
  EXPECT_EQ(read.mutation.split_link, SplitLink::disable);
  EXPECT_EQ(read.innovations.scope, InnovationScope::run);
  EXPECT_EQ(read.innovations.key, InnovationKey::link_and_function);
  EXPECT_EQ(read.reproduction.lone_place, LonePlace::elite);
  EXPECT_EQ(read.mutation.weights.reset_few_share, 0.25);
  EXPECT_EQ(read.crossover.weaker_genes, WeakerGenes::one_by_one);
  EXPECT_TRUE(read.speciation.distance.normalised);
  EXPECT_EQ(read.reproduction.stagnation_generations, 1501);
}

std::string error_about(void (*spoil)(Settings&)) {
  Settings settings;
  spoil(settings);
  return error_of([&] { settings.validate(); });
}

TEST(Settings, RefuseWhatDoesNotFitTogetherNamingTheKey) {
  EXPECT_EQ(error_about([](Settings& s) { s.speciation.target_min = 31; }),
            "'speciation.target_max' = 30: expected at least speciation.target_min = 31");
  EXPECT_EQ(error_about([](Settings& s) { s.population.size = 20; }),
            "'speciation.target_max' = 30: expected at most population.size = 20");
  EXPECT_EQ(error_about([](Settings& s) {
              s.mutation.weights_share = s.mutation.add_link_share = s.mutation.add_node_share = 0;
            }),
            "'mutation.weights_share' = 0: expected more than 0, because all other shares of mutation are 0");
  EXPECT_EQ(error_about([](Settings& s) {
              auto& w = s.mutation.weights;
              w.jiggle_many_share = w.jiggle_few_share = w.jiggle_one_share = w.reset_few_share =
                  w.reset_one_share = 0;
            }),
            "'mutation.weights.jiggle_many_share' = 0: expected more than 0, because all other shares of "
            "mutation.weights are 0");
  EXPECT_EQ(
      error_about([](Settings& s) {
        s.genome.activation_shares = {0, 0, 0, 0};
      }),
      "'genome.activation_shares.bipolar_sigmoid' = 0: expected more than 0, because the shares of all other "
      "functions are 0");
  EXPECT_EQ(
      error_about([](Settings& s) { s.genome.initial_link_probability = s.mutation.add_link_share = 0; }),
      "'mutation.add_link_share' = 0: expected more than 0, because genome.initial_link_probability is 0");
}

TEST(Settings, NeedOnlyOneShareOfEachRoulette) {
  const auto accepted = [](const Settings& settings) {
    return error_of([&] { settings.validate(); }).empty();
  };
  for (const auto share : {&MutationSettings::weights_share, &MutationSettings::add_link_share,
                           &MutationSettings::add_node_share, &MutationSettings::delete_link_share}) {
    Settings settings;
    auto& m = settings.mutation;
    m.weights_share = m.add_link_share = m.add_node_share = m.delete_link_share = 0.0;
    m.*share = 1e-9;
    EXPECT_TRUE(accepted(settings));
  }
  using Weights = WeightMutationSettings;
  for (const auto share :
       {&Weights::jiggle_many_share, &Weights::jiggle_few_share, &Weights::jiggle_one_share,
        &Weights::reset_few_share, &Weights::reset_one_share}) {
    Settings settings;
    auto& w = settings.mutation.weights;
    w.jiggle_many_share = w.jiggle_few_share = w.jiggle_one_share = w.reset_few_share = w.reset_one_share =
        0.0;
    EXPECT_FALSE(accepted(settings));
    settings.mutation.weights_share = 0.0;
    EXPECT_TRUE(accepted(settings)) << "weights are never changed";
    settings.mutation.weights_share = 1.0;
    w.*share = 1e-9;
    EXPECT_TRUE(accepted(settings));
  }
  for (std::size_t i = 0; i < activation_names.size(); ++i) {
    Settings settings;
    settings.genome.activation_shares = {};
    settings.genome.activation_shares[i] = 1e-9;
    EXPECT_TRUE(accepted(settings));
  }
}

TEST(Settings, NeedLinksFromTheStartOrLater) {
  Settings settings;
  settings.genome.initial_link_probability = 0.0;
  EXPECT_NO_THROW(settings.validate());
  settings = {};
  settings.mutation.add_link_share = 0.0;
  EXPECT_NO_THROW(settings.validate());
}

TEST(Settings, TakeTargetsOfOneNumberUpToThePopulation) {
  Settings settings;
  settings.population.size = settings.speciation.target_min = settings.speciation.target_max = 30;
  EXPECT_NO_THROW(settings.validate());
  settings.speciation.target_max = 31;
  EXPECT_THROW(settings.validate(), SettingError);
  settings.speciation.target_max = 29;
  EXPECT_THROW(settings.validate(), SettingError);
}

TEST(Settings, NameTheKeysThatCouldBeChanged) {
  const auto keys = [](void (*spoil)(Settings&)) -> std::vector<std::string> {
    Settings settings;
    spoil(settings);
    try {
      settings.validate();
    } catch (const SettingError& error) {
      return error.keys();
    }
    return {};
  };
  using Keys = std::vector<std::string>;
  EXPECT_EQ(keys([](Settings& s) { s.speciation.target_min = 31; }),
            (Keys{"speciation.target_max", "speciation.target_min"}));
  EXPECT_EQ(keys([](Settings& s) { s.population.size = 20; }),
            (Keys{"speciation.target_max", "population.size"}));
  EXPECT_EQ(keys([](Settings& s) { s.genome.initial_link_probability = s.mutation.add_link_share = 0; }),
            (Keys{"mutation.add_link_share", "genome.initial_link_probability"}));
  EXPECT_EQ(keys([](Settings& s) { s.genome.activation_shares = {}; }),
            Keys{"genome.activation_shares.bipolar_sigmoid"});
}

TEST(Settings, ScaleTheTargetsInProportionToThePopulation) {
  struct Case {
    int population, least, most;
  };
  // 28 and 30 of 300.
  for (const auto& [population, least, most] :
       {Case{300, 28, 30}, {600, 56, 60}, {100, 9, 10}, {16, 1, 2}, {2, 1, 1}}) {
    SpeciationSettings settings;
    settings.target_min = settings.target_max = 5;  // what was there before does not matter
    settings.scale_targets(population);
    EXPECT_EQ(settings.target_min, least) << population;
    EXPECT_EQ(settings.target_max, most) << population;
  }
}

}  // namespace
}  // namespace amble::neat
