#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "amble/io/json_file.hpp"
#include "amble/watch/table_tail.hpp"

namespace amble::watch {

/// How far the best so far of a run gets, from its table: the generations in which that changed, and what it
/// was from then on. Under noise it may fall: another champion is what counts then. Reads on where it
/// stopped.
class Curve {
 public:
  explicit Curve(const std::filesystem::path& table) : tail_(table) {}

  /// Reads what has come since.
  void poll();
  /// {"last": the latest generation, "steps": [[generation, best so far], …]}; evenly chosen ones and the
  /// last of more than 200. Null before the first generation.
  io::Json json() const;

 private:
  struct Step {
    int generation = 0;
    double best = 0.0;
  };
  void read(const std::string& line);

  TableTail tail_;
  std::size_t generation_at_ = 0, best_at_ = 0;  ///< columns
  bool has_header_ = false;
  int last_ = -1;
  std::vector<Step> steps_;
};

/// Those of many runs by name.
class Curves {
 public:
  /// {"runs": {name: Curve::json(), …}}, of those tables alone; a table is read as far as it has grown.
  io::Json json(const std::map<std::string, std::filesystem::path>& tables);

 private:
  std::map<std::string, Curve> curves_;
};

}  // namespace amble::watch
