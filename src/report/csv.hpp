#pragma once

#include <string>

#include "amble/report/tables.hpp"

namespace amble::report {

/// A table by RFC 4180 with a header and lines that end in "\n". Numbers read back to the same bits.
std::string to_csv(const Table& table);

/// What such a file of any study begins with, its header as far as that is the same: for telling it from
/// others (io::refuse_to_replace).
std::string csv_beginning(const Table& table);

}  // namespace amble::report
