#include "tests/exporting/compiled.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "amble/core/index.hpp"
#include "amble/io/file.hpp"

namespace amble::tests {
namespace {

namespace fs = std::filesystem;

void append(std::string& bytes, const std::vector<float>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

/// Where each neuron of the tables is among the trace's state names, which are in the order of the nodes.
std::vector<std::size_t> state_of_neurons(const exporting::NeuralTables& neural) {
  std::vector<int> nodes;
  for (const auto& neuron : neural.neurons) nodes.push_back(neuron.node);
  std::ranges::sort(nodes);
  std::vector<std::size_t> places;
  for (const auto& neuron : neural.neurons)
    places.push_back(to_index(std::ranges::find(nodes, neuron.node) - nodes.begin()));
  return places;
}

}  // namespace

Ran run_shell(const std::string& command) {
  Ran ran;
  std::FILE* const pipe = ::popen(("(" + command + ") 2>&1").c_str(), "r");
  if (pipe == nullptr) return ran;
  std::array<char, 4096> piece{};
  while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), pipe))
    ran.out.append(piece.data(), count);
  const int status = ::pclose(pipe);
  ran.exit_code = status == 0 ? 0 : 1;
  return ran;
}

exporting::CSource write_walker(const fs::path& folder, const experiment::Champion& champion,
                                exporting::Arithmetic arithmetic) {
  const std::atomic<bool> stop{false};
  const auto tables = exporting::controller_tables(champion.problem, champion.genome);
  auto source = exporting::c_source(tables, champion.problem.robot, exporting::provenance_of(champion),
                                    exporting::record_trace(champion.problem, champion.genome, 100, stop),
                                    {.prefix = "walker", .arithmetic = arithmetic, .start = "At once."});
  io::write_file(folder / "walker.h", source.header);
  io::write_file(folder / "walker.c", source.source);
  return source;
}

std::string compile(const fs::path& folder, const std::string& compiler, const std::string& flags,
                    const fs::path& main, const std::string& program) {
  const Ran ran =
      run_shell(compiler + " " + flags + " -I'" + folder.string() + "' '" + (folder / "walker.c").string() +
                "' " + (main.empty() ? std::string() : "'" + main.string() + "' ") + "-o '" +
                (folder / program).string() + "'");
  return ran.exit_code == 0 ? ran.out : "failed: " + ran.out;
}

Difference replay(const fs::path& program, const exporting::ControllerTables& tables,
                  const exporting::Trace& trace) {
  std::string sensed;
  for (const auto& tick : trace.ticks)
    for (const auto* const values : {&tick.angle_rad, &tick.touch, &tick.attitude_rad, &tick.speed_rad_s,
                                     &tick.torque_nm, &tick.yaw_rate_rad_s, &tick.load_n, &tick.command})
      append(sensed, *values);
  const fs::path in = program.string() + ".in", out = program.string() + ".out";
  io::write_file(in, sensed);
  const Ran ran = run_shell("'" + program.string() + "' < '" + in.string() + "' > '" + out.string() + "'");
  Difference difference;
  difference.printed = ran.out;
  if (ran.exit_code != 0) return difference;
  const std::string bytes = io::read_file(out);
  std::vector<float> answers(bytes.size() / sizeof(float));
  std::memcpy(answers.data(), bytes.data(), bytes.size());

  const std::size_t joints = tables.joints.size(), per_tick = joints + trace.state_names.size();
  const auto* const neural = std::get_if<exporting::NeuralTables>(&tables.parts);
  const auto places = neural ? state_of_neurons(*neural) : std::vector<std::size_t>();
  const auto differ = [](float a, float b) {
    return std::bit_cast<std::uint32_t>(a) != std::bit_cast<std::uint32_t>(b);
  };
  for (std::size_t t = 0; t < trace.ticks.size() && (t + 1) * per_tick <= answers.size(); ++t) {
    const float* const answer = answers.data() + t * per_tick;
    const exporting::Trace::Tick& tick = trace.ticks[t];
    ++difference.ticks;
    for (std::size_t j = 0; j < joints; ++j) {
      const double error_rad = std::abs(static_cast<double>(answer[j]) - tick.target_rad[j]);
      // NaN counts as large.
      if (!(error_rad <= difference.largest_rad))
        difference.largest_rad = std::isnan(error_rad) ? 1e9 : error_rad;
      difference.targets_of_other_bits += differ(answer[j], tick.target_rad[j]);
    }
    for (std::size_t i = 0; i < tick.state.size(); ++i)
      difference.states_of_other_bits += differ(answer[joints + i], tick.state[neural ? places[i] : i]);
  }
  return difference;
}

}  // namespace amble::tests
