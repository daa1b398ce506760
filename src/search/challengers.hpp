#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/search/cells.hpp"
#include "amble/search/elites.hpp"

namespace amble::search {

/// A candidate that would enter a map by the mean of its evaluations so far, and is tried again before it
/// does.
struct Challenger {
  Elite elite;                    ///< as it would enter, in the cell of its descriptor
  std::vector<float> descriptor;  ///< mean of its evaluations
  EliteName parent;
};

/// Probability that a genome stays in the cell of its mean descriptor, by the mean over many more trials. Its
/// descriptor's error comes from its own spread, with two evaluations of a usual spread added.
double staying_probability(const Cells& cells, const Elite& elite, std::span<const float> descriptor);

/// What a genome adds to a map whose cells have only what stays in them: its objective times that
/// probability.
double worth(const Cells& cells, const Elite& elite, std::span<const float> descriptor);

struct Selected {
  std::vector<Challenger> promising;
  std::vector<EliteName> parents_of_dropped;  ///< of the others, in their order
};

/// Those that are tried: one in each cell and at most `most`, in the order in which they were: first those
/// that have been tried again, then those with the largest gains, by how much their objective exceeds that of
/// their cell's elite times the probability that they stay. One in each cell, since challengers are parents
/// as well: by their gains alone they would be children of a few.
Selected most_promising(std::vector<Challenger> challengers, std::size_t most, const Cells& cells,
                        const Elites& elites);

void save_challengers(std::span<const Challenger> challengers, io::BinaryWriter& writer);
/// Throws UserError(bad_file) for more than `most`, or those that do not fit a map of so many cells and
/// dimensions.
std::vector<Challenger> load_challengers(io::BinaryReader& reader, std::size_t most, std::uint32_t cells,
                                         std::size_t dimensions);

}  // namespace amble::search
