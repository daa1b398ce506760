// A search of one's own: children of the two best genomes so far, crossed and mutated, round by round.
// Use:
//   amble --plugin build/extend/libclimb.so evolve examples/extend/climb.toml --out runs/climb
#include <memory>
#include <vector>

#include "amble/core/plugin.hpp"
#include "amble/core/random.hpp"
#include "amble/neat/crossover.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/neat/initial_genome.hpp"
#include "amble/neat/mutation.hpp"
#include "amble/search/strategies.hpp"

namespace {

using namespace amble;

/// Purposes of streams from 1000 on are for extensions.
constexpr auto climbing = static_cast<Purpose>(1000);

class Climb final : public search::Strategy {
 public:
  Climb(const search::SearchSpace& space, int mutations)
      : neat_(space.neat),
        recurrent_(space.recurrent),
        seed_(space.seed),
        mutations_(mutations),
        innovations_(space.inputs, space.outputs, space.neat.innovations) {
    for (int i = 0; i < neat_.population.size; ++i) {
      Stream stream(seed_, climbing, 0, static_cast<std::uint32_t>(i));
      candidates_.push_back(
          neat::initial_genome(neat_.genome, space.inputs, space.outputs, innovations_, stream));
    }
  }

  int round() const override { return round_; }
  std::span<const neat::Genome> ask() const override { return candidates_; }
  void tell(std::span<const search::Evaluation> evaluations) override {
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      if (!evaluations[i].viable || evaluations[i].objective <= best_) continue;
      second_ = best_ < 0.0 ? candidates_[i] : parent_;
      parent_ = candidates_[i];
      best_ = evaluations[i].objective;
    }
    if (best_ < 0.0) parent_ = second_ = candidates_.front();
    ++round_;
    breed();
  }
  std::vector<search::Metric> metrics() const override { return {{"climb_best", best_}}; }

  // What a checkpoint must hold: random numbers follow from the round and the seed.
  void save(io::BinaryWriter& writer) const override {
    writer.put(round_);
    writer.put(best_);
    neat::save(parent_, writer);
    neat::save(second_, writer);
    neat::save(candidates_, writer);
    innovations_.save(writer);
  }
  void load(io::BinaryReader& reader) override {
    round_ = reader.get<int>();
    best_ = reader.get<double>();
    parent_ = neat::load_genome(reader);
    second_ = neat::load_genome(reader);
    candidates_ = neat::load_genomes(reader);
    innovations_.load(reader);
  }

 private:
  void breed() {
    innovations_.begin_generation();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      Stream stream(seed_, climbing, static_cast<std::uint32_t>(round_), static_cast<std::uint32_t>(i));
      candidates_[i] = neat::crossover(parent_, second_, neat_.crossover, recurrent_, stream);
      for (int m = 0; m < mutations_; ++m)
        neat::mutate(candidates_[i], neat_, recurrent_, innovations_, stream);
    }
  }

  const neat::Settings neat_;
  bool recurrent_;
  std::uint64_t seed_;
  int mutations_, round_ = 0;
  double best_ = -1.0;
  neat::Innovations innovations_;
  neat::Genome parent_, second_;  // the best so far, and the best before it
  std::vector<neat::Genome> candidates_;
};

}  // namespace

AMBLE_PLUGIN {
  amble::search::register_search(
      {.name = "climb",
       .behaviour = "",
       .make = [](const amble::search::Settings& settings,
                  const amble::search::SearchSpace& space) -> std::unique_ptr<amble::search::Strategy> {
         return std::make_unique<Climb>(space, static_cast<int>(settings.own.numbers.at("mutations")));
       },
       .numbers = {
           {.name = "mutations", .value = 2, .range = {1, 100}, .what = "mutations of each candidate"}}});
}
