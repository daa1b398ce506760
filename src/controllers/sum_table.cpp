#include "amble/controllers/sum_table.hpp"

namespace amble::controllers {

SumTableBuilder::SumTableBuilder(SumTable& table, int capacity, int lanes) : table_(table), lanes_(lanes) {
  constexpr int line = LaneRows::line_lanes;
  table_ = {.groups = {},
            .neurons = {},
            .sources = {},
            .weights = LaneRows(capacity * ((lanes + line - 1) / line), line),
            .capacity = capacity};
}

void SumTableBuilder::add_neuron(std::uint32_t row, int links) {
  table_.neurons.push_back(row);
  if (table_.groups.size() > level_ && table_.groups.back().links == links)
    ++table_.groups.back().neurons;
  else
    table_.groups.push_back({links, 1});
}

void SumTableBuilder::add_link(std::uint32_t source, const float* weights) {
  constexpr int line = LaneRows::line_lanes;
  const int link = static_cast<int>(table_.sources.size());
  for (int lane = 0; lane < lanes_; ++lane)
    table_.weights.at(lane / line * table_.capacity + link, lane % line) = weights[lane];
  table_.sources.push_back(source);
}

}  // namespace amble::controllers
