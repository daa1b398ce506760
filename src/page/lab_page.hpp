#pragma once

#include <string>
#include <utility>
#include <vector>

#include "amble/io/json_file.hpp"

namespace amble::page {

/// A robot of the lab.
struct LabRobot {
  std::string id, name;
  std::string text;  ///< of its robot.json
  /// By the names of controllers, which viewer/src/lab/form.js knows: experiment::Config as JSON.
  std::vector<std::pair<std::string, io::Json>> configs;
};

/// The lab: a self-contained page in which robots evolve (docs/LAB.md), for any browser of 2023 or later. At
/// least one robot, whose configs have "supg".
std::string make_lab_page(const std::vector<LabRobot>& robots, const std::string& made_by);

}  // namespace amble::page
