#include "amble/experiment/plan/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/io/binary.hpp"
#include "amble/io/json_file.hpp"

namespace amble::experiment {
namespace {

constexpr std::string_view magic = "AMBLECKP";

/// The version of a file, as far as it can be read.
std::uint32_t version_of(std::string_view bytes) {
  io::BinaryReader reader(bytes.substr(std::min(bytes.size(), magic.size())), "");
  const bool has_it = bytes.size() >= magic.size() + sizeof(std::uint32_t);
  return has_it && reader.get<std::uint32_t>() == undigested_checkpoint_version
             ? undigested_checkpoint_version
             : checkpoint_version;
}

/// Hash of a run's config without what may change on resume.
std::uint64_t config_hash(const Config& config) {
  return hash_text(fmt::format("{} {} {}", config.seed, config.name, config.identity()));
}

}  // namespace

search::SearchSpace space_of(const Config& config, const Problem& problem) {
  const auto behaviour = config.make_behaviour();
  return {.neat = config.neat,
          .inputs = problem.cppn_inputs(),
          .outputs = problem.cppn_outputs(),
          .recurrent = config.cppn.recurrent,
          .seed = static_cast<std::uint64_t>(config.seed),
          .behaviour_length = behaviour->length(),
          .circles = behaviour->circles()};
}

RunState::RunState(const Config& config, const Problem& problem)
    : strategy(search::strategy_kind(config.search).make(config.search, space_of(config, problem))) {}

std::string checkpoint_bytes(const Config& config, const Progress& progress,
                             const search::Strategy& strategy) {
  io::BinaryWriter writer;
  writer.put(config_hash(config));
  writer.put(progress.best);
  writer.put(static_cast<std::int32_t>(progress.best_generation));
  writer.put(progress.evaluations);
  writer.put(progress.steps);
  writer.put(progress.wall_s);
  writer.put(progress.csv_bytes);
  writer.put(progress.csv_digest);
  strategy.save(writer);
  return io::seal(magic, checkpoint_version, writer.bytes());
}

Progress parse_checkpoint(std::string_view bytes, const std::string& what, const Config& config,
                          search::Strategy& strategy) {
  const std::uint32_t version = version_of(bytes);
  const std::string_view payload = io::unseal(magic, version, bytes, what);
  if (io::BinaryReader(payload, what).get<std::uint64_t>() != config_hash(config))
    fail(ExitCode::bad_file,
         "{}: written under another config.toml than the one beside it; restore that, or start a new run",
         what);
  return load_progress(payload.substr(sizeof(std::uint64_t)), what, strategy, version);
}

Progress load_progress(std::string_view payload, const std::string& what, search::Strategy& strategy,
                       std::uint32_t version) {
  io::BinaryReader reader(payload, what);
  Progress progress;
  progress.best = reader.get<double>();
  progress.best_generation = reader.get<std::int32_t>();
  progress.evaluations = reader.get<std::uint64_t>();
  progress.steps = reader.get<std::uint64_t>();
  progress.wall_s = reader.get<double>();
  progress.csv_bytes = reader.get<std::uint64_t>();
  if (version != undigested_checkpoint_version) progress.csv_digest = reader.get<std::uint64_t>();
  if (!std::isfinite(progress.best) || !std::isfinite(progress.wall_s))
    reader.bad("a number that is not finite");
  strategy.load(reader);
  reader.finish();
  return progress;
}

}  // namespace amble::experiment
