#include "amble/experiment/run_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/record/generations_csv.hpp"

namespace amble::experiment {
namespace {

std::string_view without_end(std::string_view line) {
  if (line.ends_with('\n')) line.remove_suffix(1);
  return line;
}

/// What no number in the table is without: nothing else is in a cell that a run wrote.
bool is_number(std::string_view cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.+-einfa") == std::string_view::npos;
}

class TableCheck {
 public:
  TableCheck(const RunPaths& paths, const search::Strategy& strategy)
      : folder_(paths.folder.string()),
        file_(paths.generations.string()),
        strategy_(strategy),
        text_(read(paths.generations)) {}

  std::uint64_t check(const Progress& progress) {
    std::string_view rest = text_;
    if (rest.size() < progress.csv_bytes)
      bad(1 + static_cast<int>(std::ranges::count(rest, '\n')),
          fmt::format("it ends after {} bytes of {}", rest.size(), progress.csv_bytes));
    const std::string_view header = take_line(rest);
    check_header(without_end(header));
    std::uint64_t digest = table_digest(0, header, header);
    const int rows = strategy_.round();
    for (int row = 0; row < rows; ++row) {
      const std::string_view line = take_line(rest);
      check_row(row, line, line.ends_with('\n'));
      digest = table_digest(digest, header, line);
    }
    if (progress.csv_digest != 0 && digest != progress.csv_digest)
      bad(0, "a number is not the one that the run wrote");
    if (text_.size() - rest.size() != progress.csv_bytes)
      bad(0, fmt::format("its {} rows have {} bytes, and had {}", rows, text_.size() - rest.size(),
                         progress.csv_bytes));
    check_tail(rows, rest);
    return digest;
  }

 private:
  std::string read(const std::filesystem::path& path) const {
    if (!std::filesystem::exists(path)) bad(0, "it is missing");
    return io::read_file(path);
  }

  static std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, text.empty() ? 0 : end);
    text.remove_prefix(line.size());
    return line;
  }

  void check_header(std::string_view header) {
    columns_ = io::split(header, ',').size();
    if (const auto unknown = unknown_column(header, strategy_.metrics()); !unknown.empty())
      fail(ExitCode::bad_file, "{}:1: column '{}': expected the columns of the run; {}", file_,
           io::printable(unknown), way_out());
  }

  /// `whole`: it must not be the beginning of a row.
  void check_row(int row, std::string_view line, bool whole) const {
    const int number = row + 2;
    const auto cells = io::split(without_end(line), ',');
    for (const std::string_view cell : cells)
      if (!is_number(cell) && (whole || !cell.empty()))
        bad(number, fmt::format("'{}', where the run writes plain numbers", io::printable(cell)));
    if (whole ? cells.size() != columns_ : cells.size() > columns_)
      bad(number, fmt::format("{} columns, where the run has {}", cells.size(), columns_));
    const std::string generation = std::to_string(row);
    const bool begins = whole || cells.size() > 1 ? cells[0] == generation : generation.starts_with(cells[0]);
    if (!begins) bad(number, fmt::format("generation {}, where the run has {}", cells[0], row));
    if (!whole && row < strategy_.round()) bad(number, "it breaks off");
  }

  /// Rows that a killed process was ahead of its checkpoint; the last may break off, and after a power cut a
  /// file may end in zeros.
  void check_tail(int row, std::string_view rest) const {
    while (rest.ends_with('\0')) rest.remove_suffix(1);
    for (; !rest.empty(); ++row) {
      const std::string_view line = take_line(rest);
      check_row(row, line, line.ends_with('\n'));
    }
  }

  std::string way_out() const {
    return fmt::format(
        "the file was changed since the run wrote it; nothing has been done now. Put back a copy of it, or "
        "evolve the run anew, to the same bits: amble evolve {} --out NEW_FOLDER",
        io::shell_word(folder_ + "/config.toml"));
  }
  [[noreturn]] void bad(int line, const std::string& found) const {
    fail(ExitCode::bad_file, "{}{}: {}: {}", file_, line > 0 ? fmt::format(":{}", line) : "", found,
         way_out());
  }

  std::string folder_, file_;
  const search::Strategy& strategy_;
  std::string text_;
  std::size_t columns_ = 0;
};

}  // namespace

std::uint64_t check_table(const RunPaths& paths, const Progress& progress, const search::Strategy& strategy) {
  return TableCheck(paths, strategy).check(progress);
}

}  // namespace amble::experiment
