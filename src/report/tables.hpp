#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "amble/report/report.hpp"

namespace amble::report {

/// A number in full precision, a text, or nothing.
using Cell = std::variant<std::monostate, std::string, double, std::int64_t>;

/// One file of CSV and one list of the JSON document.
struct Table {
  std::string name;                 ///< "runs"; the file is runs.csv
  std::string about;                ///< what a row is
  std::vector<std::string> header;  ///< the same in every report, but for the tests of "runs"
  std::vector<std::vector<Cell>> rows;
  std::size_t fixed_columns = 0;  ///< the first ones, which every report has; 0: all
};

/// All numbers of a report, and those of the runs from which they can be computed again: runs, bests, curves,
/// summary, pairs, survival, log_rank, gaits, transfer, mutants, claims; of studies with tests at a level:
/// typical.
std::vector<Table> tables(const Report& report);

/// A table by RFC 4180 with a header and lines that end in "\n". Numbers read back to the same bits.
std::string to_csv(const Table& table);

/// What such a file of any study begins with, its header as far as that is the same: for telling it from
/// others (io::refuse_to_replace).
std::string csv_beginning(const Table& table);

}  // namespace amble::report
