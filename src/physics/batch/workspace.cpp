#include "amble/physics/batch/workspace.hpp"

namespace amble::physics::batch {

float* thread_scratch(std::size_t floats) {
  thread_local std::vector<Row> rows;
  if (rows.size() * lanes < floats) rows.resize((floats + lanes - 1) / lanes);
  return rows.data()->lane.data();
}

}  // namespace amble::physics::batch
