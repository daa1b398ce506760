#include "amble/browser/run_interface.hpp"

#include <memory>
#include <string>

#include "amble/browser/run.hpp"
#include "amble/browser/texts.hpp"
#include "amble/browser/trials.hpp"
#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"

namespace {

using namespace amble::browser;

std::shared_ptr<const Plan> plan;
std::unique_ptr<Trials> trials;
std::unique_ptr<Run> run;
Files given, files;

Run& open_run() {
  AMBLE_CHECK(run != nullptr, "a run is begun first");
  return *run;
}
Trials& open_trials() {
  AMBLE_CHECK(trials != nullptr, "genomes come first");
  return *trials;
}

}  // namespace

void amble_robot_facts() {
  give_text(robot_facts(taken_text()));
}
void amble_run_plan() {
  plan = std::make_shared<const Plan>(taken_text());
  trials.reset();
}

void amble_trials_begin(int generation) {
  AMBLE_CHECK(plan != nullptr, "a plan comes first");
  if (!trials) trials = std::make_unique<Trials>(plan);
  trials->begin(generation, taken_text());
}
int amble_trials_advance(int steps) {
  return open_trials().advance(steps);
}
void amble_trials_told() {
  give_text(open_trials().told().bytes());
}

void amble_run_begin() {
  AMBLE_CHECK(plan != nullptr, "a plan comes first");
  run = std::make_unique<Run>(plan);
}
void amble_run_file() {
  const std::string& text = taken_text();
  const std::size_t end = text.find('\0');
  AMBLE_CHECK(end != std::string::npos, "a path and a zero byte");
  given[text.substr(0, end)] = text.substr(end + 1);
}
void amble_run_resume() {
  AMBLE_CHECK(plan != nullptr, "a plan comes first");
  run = std::make_unique<Run>(plan, given);
  given.clear();
}
void amble_run_change() {
  const auto changed = std::make_shared<const Plan>(taken_text());
  open_run().change(changed);
  plan = changed;
  trials.reset();
}

std::size_t amble_run_candidates() {
  return open_run().candidates();
}
void amble_run_candidates_of(std::size_t first, std::size_t count) {
  give_text(open_run().candidates(first, count));
}
void amble_run_take(std::size_t first) {
  open_run().take(first, taken_text());
}
void amble_run_tell(double wall_s) {
  open_run().tell(wall_s);
  give_text(open_run().progress_json());
}
void amble_run_describe() {
  give_text(open_run().describe());
}
void amble_run_progress() {
  give_text(open_run().progress_json());
}
void amble_run_champion() {
  give_text(open_run().champion());
}
void amble_run_first() {
  give_text(open_run().first());
}
void amble_run_elite(unsigned cell) {
  give_text(open_run().elite(cell));
}
void amble_run_files() {
  files = open_run().files();
  amble::io::Json paths = amble::io::Json::array();
  for (const auto& [path, content] : files) paths.push_back(path);
  give_text(paths.dump());
}
void amble_run_give_file() {
  const auto found = files.find(taken_text());
  if (found == files.end()) amble::fail(amble::ExitCode::bad_input, "{}: no file of the run", taken_text());
  give_text(found->second);
}
