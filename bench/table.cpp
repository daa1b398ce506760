#include "bench/table.hpp"

#include <fmt/format.h>

namespace amble::bench {
namespace {

std::string number_text(double value) {
  if (value >= 1e5) return fmt::format("{:.3g}", value);
  return fmt::format("{:.{}f}", value, value >= 100.0 ? 0 : value >= 10.0 ? 1 : value >= 1.0 ? 2 : 4);
}

}  // namespace

std::string to_text(const std::vector<Figure>& figures) {
  std::string ratios, rest;
  for (const auto& figure : figures) {
    const bool ratio = figure.unit == "1";
    (ratio ? ratios : rest) += fmt::format("{:<44} {:>10} {:<8} {}\n", figure.name, number_text(figure.value),
                                           ratio ? "x" : figure.unit, figure.note);
  }
  return ratios + "\n" + rest;
}

std::string to_csv(const std::vector<Figure>& figures, const std::vector<Circumstance>& circumstances) {
  std::string csv = "name,value,unit\n";
  for (const auto& figure : figures) csv += fmt::format("{},{},{}\n", figure.name, figure.value, figure.unit);
  for (const auto& [name, text] : circumstances) csv += fmt::format("{},\"{}\",\n", name, text);
  return csv;
}

}  // namespace amble::bench
