#include "amble/watch/curves.hpp"

#include <algorithm>
#include <string_view>

#include "amble/core/index.hpp"
#include "amble/io/text.hpp"
#include "amble/record/generations_csv.hpp"

namespace amble::watch {
namespace {

constexpr std::size_t most_steps = 200;
constexpr double most_generations = 1e9;

}  // namespace

void Curve::poll() {
  const auto growth = tail_.poll();
  if (growth.anew) {
    has_header_ = false;
    last_ = -1;
    steps_.clear();
  }
  for (const std::string& line : growth.lines) read(line);
}

void Curve::read(const std::string& line) {
  const auto cells = io::split(line, ',');
  if (!has_header_) {
    const auto place = [&cells](std::string_view column) {
      return to_index(std::ranges::find(cells, column) - cells.begin());
    };
    generation_at_ = place(record::column::generation);
    best_at_ = place(record::column::best_so_far);
    has_header_ = true;
    return;
  }
  if (std::max(generation_at_, best_at_) >= cells.size()) return;
  const auto generation = number_in(cells[generation_at_]), best = number_in(cells[best_at_]);
  if (!generation || !(*generation >= 0.0 && *generation <= most_generations)) return;
  last_ = static_cast<int>(*generation);
  if (best && (steps_.empty() || *best != steps_.back().best)) steps_.push_back({last_, *best});
}

io::Json Curve::json() const {
  if (last_ < 0 || steps_.empty()) return {};
  io::Json steps = io::Json::array();
  const std::size_t every = (steps_.size() + most_steps - 1) / most_steps;
  for (std::size_t i = 0; i < steps_.size(); ++i)
    if (i % every == 0 || i + 1 == steps_.size()) steps.push_back({steps_[i].generation, steps_[i].best});
  return {{"last", last_}, {"steps", std::move(steps)}};
}

io::Json Curves::json(const std::map<std::string, std::filesystem::path>& tables) {
  std::erase_if(curves_, [&tables](const auto& curve) { return !tables.contains(curve.first); });
  io::Json runs = io::Json::object();
  for (const auto& [name, table] : tables) {
    Curve& curve = curves_.try_emplace(name, table).first->second;
    curve.poll();
    io::Json json = curve.json();
    if (!json.is_null()) runs[name] = std::move(json);
  }
  return {{"runs", std::move(runs)}};
}

}  // namespace amble::watch
