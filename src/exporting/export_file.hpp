#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/exporting/c_source.hpp"

namespace amble::exporting {

/// Steers a champion that is to be exported by hand, as `amble trial --steering` does
/// (experiment::steer_by_hand). One that was told nothing is told straight on, both turns and a stop in the
/// ticks of the self-test.
void steer_by_hand(experiment::Champion& champion, const std::string& gains, const std::string& what);

/// Writes a champion's controller as `out`, a name that ends in .c and is an identifier before, and as a
/// header beside it. Nothing is written if `stop` was set. Throws UserError: another name, a file that is no
/// exported controller, a controller that has no tables.
void write_c(const experiment::Champion& champion, const std::filesystem::path& out, Arithmetic arithmetic,
             const std::atomic<bool>& stop);

/// "amble-export" (docs/EXPORT.md). Throws UserError for a controller that has no tables.
std::string export_json(const experiment::Champion& champion, const std::atomic<bool>& stop);
/// With what the text begins.
inline constexpr std::string_view export_json_start = "{\n  \"format\": \"amble-export\"";

}  // namespace amble::exporting
