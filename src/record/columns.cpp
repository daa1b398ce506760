#include "amble/record/recording.hpp"

namespace amble::record {

std::vector<std::string> standard_columns(const std::vector<std::string>& joints,
                                          const std::vector<std::string>& legs) {
  std::vector<std::string> columns;
  for (const char* name : {"x", "y", "z", "qw", "qx", "qy", "qz"})
    columns.push_back(std::string("root.") + name);
  for (const char* name : {"x", "y", "z"}) columns.push_back(std::string("com.") + name);
  for (const std::string& joint : joints) columns.push_back("angle." + joint);
  for (const std::string& joint : joints) columns.push_back("target." + joint);
  for (const std::string& leg : legs) columns.push_back("touch." + leg);
  return columns;
}

std::vector<std::string> torque_columns(const std::vector<std::string>& joints) {
  std::vector<std::string> columns;
  columns.reserve(joints.size());
  for (const std::string& joint : joints) columns.push_back("torque." + joint);
  return columns;
}

std::vector<std::string> load_columns(const std::vector<std::string>& legs) {
  std::vector<std::string> columns;
  columns.reserve(legs.size());
  for (const std::string& leg : legs) columns.push_back("load." + leg);
  return columns;
}

std::vector<std::string> command_columns() {
  return {"command.speed", "command.turn"};
}

}  // namespace amble::record
