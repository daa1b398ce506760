#include "amble/watch/feed.hpp"

#include <iterator>
#include <utility>

namespace amble::watch {

bool Feed::poll(double now_s) {
  auto growth = table_.poll();
  if (growth.anew) {
    lines_.clear();
    ++beginning_;
  }
  lines_.insert(lines_.end(), std::make_move_iterator(growth.lines.begin()),
                std::make_move_iterator(growth.lines.end()));
  const io::Json population = population_.poll(now_s);
  if (!population.is_null()) {
    population_text_ = population.dump();
    ++populations_;
  }
  return growth.anew || !growth.lines.empty() || !population.is_null();
}

}  // namespace amble::watch
