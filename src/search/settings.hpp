#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/own_settings.hpp"
#include "amble/io/settings.hpp"

namespace amble::search {

/// Distance of two behaviours.
enum class Distance {
  squared,  ///< the sum of squared differences (the authors' code)
  root      ///< its root (Morse et al. 2013, sec. 4)
};
/// As configs write them, by Distance.
inline constexpr std::array<std::string_view, 2> distance_names{"squared", "root"};

/// The behaviours that a candidate's novelty is measured against.
enum class Neighbours {
  archive,                ///< the archive alone (the authors' code)
  archive_and_population  ///< and the rest of its generation (Lehman & Stanley 2011)
};
/// As configs write them, by Neighbours.
inline constexpr std::array<std::string_view, 2> neighbours_names{"archive", "archive_and_population"};

/// After the threshold was lowered because so many generations in a row added no candidate: when it is
/// lowered again.
enum class Lowering {
  each_generation,  ///< in each further such generation (the authors' code)
  count_anew        ///< after as many more (Lehman's code)
};
/// As configs write them, by Lowering.
inline constexpr std::array<std::string_view, 2> lowering_names{"each_generation", "count_anew"};

/// Novelty search (Lehman & Stanley 2011; Morse et al. 2013, sec. 4): a behaviour is the path of the centre
/// of mass over the ground; candidates that are new enough join an archive. The defaults are what the
/// authors' code did. Ranges are those that describe() holds a config to. Novelties, and so thresholds, are
/// in m², or in m with Distance::root, summed over the path's samples and the neighbours.
struct NoveltySettings {
  int path_stride = 2;      ///< the path is sampled once in every so many steps, 1 … 1e6 (the paper: 1)
  int path_first_step = 1;  ///< in which of them, 1 … path_stride
  Distance distance = Distance::squared;          ///< how far two paths are apart
  Neighbours compare_with = Neighbours::archive;  ///< among which the nearest neighbours are searched
  int neighbours = 15;  ///< novelty sums the distances to so many, 1 … 1e6; absent ones count 0
  /// In generation 0 candidates that are more novel than this join the archive, 1e−9 … 1e12.
  double threshold = 1000.0;
  int first_members = 15;  ///< while the archive has fewer members, all candidates join, 0 … 1e6
  /// Whether those that joined for that alone count when the threshold adapts (Lehman's code: true); more
  /// novel ones always do.
  bool count_first_members = false;
  int raise_above = 4;        ///< a generation that adds more raises the threshold, 0 … 1e6
  double raise_factor = 1.2;  ///< by this factor, 1 … 1000
  int lower_after = 4;  ///< so many generations in a row that add none lower it, 1 … 1e6 (Lehman's code: 10)
  Lowering lowering = Lowering::each_generation;  ///< when it is lowered again
  double lower_factor = 0.8;                      ///< by this factor, 0.001 … 1 (Lehman's code: 0.95)
  double lowest_threshold = 0.0;                  ///< lowering ends here, 0 … 1e12 (Lehman's code: 0.25)
  int archive_limit = 50000;                      ///< most members; then none joins, 1 … 1e9

  void describe(io::SettingsVisitor& visitor);  ///< the table [search.novelty]
  /// Throws SettingError: path_first_step above path_stride, or behaviours of this length (numbers) that are
  /// empty or longer than can be compared.
  void validate(std::size_t behaviour_length) const;
  /// Throws SettingError where a full archive and a generation of `population` candidates would not fit into
  /// `memory_bytes`. For running a search only: a config may be read on a smaller machine.
  void check_memory(std::size_t behaviour_length, int population, double memory_bytes) const;
};

/// One dimension of a map: a quantity of trials and its range.
struct DescriptorSettings {
  std::string quantity = "duty_factor";  ///< name of a row of score::quantities()
  std::string leg;     ///< name of a leg, for a quantity that legs have; empty: the mean over legs
  double least = 0.0,  ///< lower end of its range, in its unit, −1e9 … 1e9; less falls into the first bin
      most = 1.0;      ///< upper end, above the lower; more falls into the last bin
  int bins = 10;       ///< bins of equal width, 1 … 1e6; without effect unless Archive::grid

  /// For axes and tables: "duty_factor FL".
  std::string label() const { return leg.empty() ? quantity : quantity + " " + leg; }
  void describe(io::SettingsVisitor& visitor);  ///< an item of search.map_elites.descriptors
};

/// Cells of a map.
enum class Archive {
  grid,  ///< bins of each descriptor (Mouret & Clune 2015)
  cvt    ///< surroundings of evenly spread centroids (Vassiliades, Chatzilygeroudis & Mouret 2018)
};
/// As configs write them, by Archive.
inline constexpr std::array<std::string_view, 2> archive_names{"grid", "cvt"};

/// How parents are drawn from the elites.
enum class Selection {
  uniform,    ///< any, equally likely
  objective,  ///< that with the better objective of two
  curiosity,  ///< the more curious of two (Cully & Demiris 2018)
  dominated   ///< any of a pool beside the map, of those unlike all that are better (Bahlous-Boldi et al.
              ///< 2025)
};
/// As configs write them, by Selection.
inline constexpr std::array<std::string_view, 4> selection_names{"uniform", "objective", "curiosity",
                                                                 "dominated"};

/// How new genomes come from those of a map.
enum class Variation {
  mutation,  ///< mutated copies and children of two, by NEAT
  line,      ///< weights alone, along the line to another elite (Vassiliades & Mouret 2018)
  cma        ///< weights alone, by CMA-ES towards what improves the map (Fontaine & Nikolaidis 2023)
};
/// As configs write them, by Variation.
inline constexpr std::array<std::string_view, 3> variation_names{"mutation", "line", "cma"};

/// Variation::line ("iso+line"): each weight of a copy moves by a normal number of its own, and along the
/// line to the mate by one more that all weights share.
struct LineSettings {
  double iso_sigma = 0.02;  ///< standard deviation of a weight's own step, in the unit of weights, 0 … 1000
  double line_sigma =
      0.2;  ///< standard deviation of the shared one, as a share of the way to the mate, 0 … 1000

  void describe(io::SettingsVisitor& visitor);  ///< the table [search.map_elites.line]
  bool operator==(const LineSettings&) const = default;
};

/// Variation::cma: CMA-MAE. Each emitter is a distribution of its own; what `reevaluate_share` leaves of a
/// batch is shared out evenly.
struct CmaEmitterSettings {
  int emitters = 16;  ///< distributions, 1 … 1e4
  double step = 0.1;  ///< standard deviation of each weight where one begins (σ₀), 1e−9 … 1000
  /// How much of the way a cell's threshold goes to the objective of a candidate that exceeds it (α), 0 … 1.
  /// 0: a search for the best alone; 1: nearly CMA-ME, but that several of a round count by their mean, a new
  /// cell counts by how far it exceeds `least_threshold` and not before all others, and an emitter that
  /// improves nothing goes on.
  double learning_rate = 0.01;
  double least_threshold = 0.0;  ///< of a cell at first, in the unit of the score (min_f), −1e9 … 1e9

  void describe(io::SettingsVisitor& visitor);  ///< the table [search.map_elites.cma]
  bool operator==(const CmaEmitterSettings&) const = default;
};

/// Selection::dominated (dominated_pool.hpp).
struct PoolSettings {
  int size = 1024;     ///< genomes, 2 … 1e4
  int neighbours = 3;  ///< better ones to which a distance counts (k), 1 … 100

  void describe(io::SettingsVisitor& visitor);  ///< the table [search.map_elites.pool]
  bool operator==(const PoolSettings&) const = default;
};

/// MAP-Elites (Mouret & Clune 2015; docs/REPERTOIRES.md). Ranges are those that describe() holds a config to.
struct MapElitesSettings {
  std::vector<DescriptorSettings> descriptors = {};  ///< dimensions of the map; there must be one
  Archive archive = Archive::grid;                   ///< what its cells are
  int cells = 10000;                                 ///< Archive::cvt: centroids, 1 … most_cells
  int centroid_samples = 100000;   ///< Archive::cvt: points of which they are made, cells … most_cells
  std::int64_t centroid_seed = 1;  ///< Archive::cvt: seed of these points, not the run's, 0 … 1e18
  int batch = 1024;                ///< genomes evaluated in a round, 1 … 1e6
  /// Random genomes in the first rounds, rounded up to whole rounds, 1 … 1e9; challengers (`trials`) take
  /// places among them. Without effect with Variation::cma.
  int initial = 4096;
  Selection select = Selection::uniform;  ///< how parents are drawn
  double crossover_probability = 0.0;  ///< that a child has two parents, 0 … 1; else it is a mutated copy
  /// Share of a batch in which elites are evaluated again, those with the fewest evaluations first, 0 … 0.9.
  /// Makes sense under noise.
  double reevaluate_share = 0.0;
  /// Evaluations that a candidate needs at least before it enters the map, each under another round's noise,
  /// 1 … 1e6 (Justesen, Risi & Mouret 2019; Flageat & Cully 2023).
  int trials = 1;
  /// Most of a batch that are candidates tried again before they enter, the most promising ones, 0 … 0.9.
  /// Without effect if `trials` is 1.
  double challenger_share = 0.35;
  Variation variation = Variation::mutation;  ///< how new genomes come from elites
  PoolSettings pool;                          ///< Selection::dominated
  LineSettings line;                          ///< Variation::line
  CmaEmitterSettings cma;                     ///< Variation::cma

  void describe(io::SettingsVisitor& visitor);  ///< the table [search.map_elites]
  /// Throws SettingError for what cannot be: a map without descriptors or with too many, a range below 1e−9,
  /// too many cells, fewer samples than centroids, shares that leave no room for new genomes or none for
  /// challengers, emitters without candidates or beside candidates that are tried again.
  void validate() const;
  /// Cells of the map; 0 if there are more than most_cells.
  std::uint32_t cell_count() const;
  /// How many candidates of a batch are elites evaluated again; at most the number of elites.
  std::size_t reevaluations(std::size_t elites) const;
  /// Whether a candidate can need more than one evaluation to enter the map.
  bool tries_candidates_again() const { return trials > 1; }
  /// Candidates of each emitter in a round; 0 if they cannot be shared out evenly.
  int candidates_per_emitter() const;
  /// Candidates at most that are tried again in a round before they enter.
  std::size_t most_challengers() const;

 private:
  void validate_variation() const;
};

/// Largest number of cells of a map.
inline constexpr std::uint32_t most_cells = 20'000'000;

/// Fewest candidates of a round of CMA-ES.
inline constexpr int least_cma_es_candidates = 4;

/// CMA-ES on the weights of a CPPN that never grows (Hansen, arXiv 1604.00772). In the unit of weights.
struct CmaEsSettings {
  double step = 0.3;         ///< standard deviation of each weight in the first round, 1e−9 … 1000
  double least_step = 1e-6;  ///< begins again elsewhere when none has a larger one, 0 … 1000, below `step`

  void describe(io::SettingsVisitor& visitor);  ///< the table [search.cma_es]
  bool operator==(const CmaEsSettings&) const = default;
};

/// The search strategy, and the settings of each; those of other kinds are without effect.
struct Settings {
  std::string kind = "objective";  ///< the name of a StrategyKind
  NoveltySettings novelty;         ///< kind "novelty"
  MapElitesSettings map_elites;    ///< kind "map-elites"
  CmaEsSettings cma_es;            ///< kind "cma-es"
  io::OwnSettings own;             ///< a kind that a program or a plugin has added

  /// The table [search]. AMBLE_CHECK: the kind is known, as it is after reading.
  void describe(io::SettingsVisitor& visitor);
};

}  // namespace amble::search
