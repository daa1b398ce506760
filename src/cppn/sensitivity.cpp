#include "amble/cppn/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/cppn/reference.hpp"

namespace amble::cppn {

double precision_sensitivity(const neat::Genome& genome, const Settings& settings, const Points& points) {
  const Network single(genome, settings);
  const Reference reference(genome, settings);
  std::vector<float> results(to_index(single.outputs()) * to_index(points.capacity()));
  single.evaluate(points, results);
  std::vector<double> inputs(to_index(points.inputs())), outputs(to_index(single.outputs()));
  double largest = 0.0;
  for (int point = 0; point < points.count(); ++point) {
    for (int i = 0; i < points.inputs(); ++i) inputs[to_index(i)] = points.get(point, i);
    reference.evaluate(inputs, outputs);
    for (std::size_t output = 0; output < outputs.size(); ++output) {
      const double value = results[output * to_index(points.capacity()) + to_index(point)];
      largest =
          std::max(largest, std::abs(std::clamp(value, -1.0, 1.0) - std::clamp(outputs[output], -1.0, 1.0)));
    }
  }
  return largest;
}

}  // namespace amble::cppn
