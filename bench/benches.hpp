#pragma once

#include <string>
#include <vector>

#include "bench/table.hpp"

namespace amble::bench {

/// A tick of each kind of controller.
void measure_controllers(std::vector<Figure>& figures);
/// Queries of evolved CPPNs: batched against point by point.
void measure_cppn(std::vector<Figure>& figures);
/// MAP-Elites on a function without physics.
void measure_map_elites(std::vector<Figure>& figures);
/// Breeding and speciating 300 genomes.
void measure_neat(std::vector<Figure>& figures);
/// Judging a generation by novelty: against plain loops.
void measure_novelty(std::vector<Figure>& figures);
/// Steps per second of the engines alone, on the same robots with the same targets.
void measure_physics(std::vector<Figure>& figures);
/// Many robots in the batch engine, beside one in MuJoCo: what bench/robots.py compares Python's with.
void measure_robots(std::vector<Figure>& figures);
/// The robot of a config, all joints swinging, in the config's engine with its settings, beside mj_step: on
/// one core, and on all. Throws UserError as experiment::load_config() and load_robot().
void measure_config(const std::string& config_file, std::vector<Figure>& figures);
/// Whole runs: evaluations per second by workers, share outside physics, memory.
void measure_runs(std::vector<Figure>& figures);
/// A run of the paper's size in the batch engine, from beginning to end: minutes.
void measure_whole_run(std::vector<Figure>& figures);

}  // namespace amble::bench
