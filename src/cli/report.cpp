#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "amble/cli/help.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/core/error.hpp"
#include "amble/experiment/run_paths.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/report/figures.hpp"
#include "amble/report/page.hpp"
#include "amble/report/report.hpp"
#include "amble/report/tables.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  fs::path study, out;
  std::optional<fs::path> csv, json, figures;
};

/// A file to be written, and what a file that it may replace begins with.
struct Output {
  fs::path path;
  std::string text, beginning, what;
};

std::vector<Output> outputs(const report::Report& made, const ReportOptions& options) {
  std::vector<Output> files{{options.out, report::make_page(made), "<!DOCTYPE html>", "a page"}};
  if (options.csv)
    for (const report::Table& table : report::tables(made))
      files.push_back({*options.csv / (table.name + ".csv"), report::to_csv(table),
                       report::csv_beginning(table), "a table of a report"});
  if (options.json)
    files.push_back({*options.json, report::to_json(made),
                     fmt::format("{{\n  \"format\": \"{}\"", report::report_format), "a report"});
  if (options.figures)
    for (report::FigureFile& figure : report::figure_files(made))
      files.push_back({*options.figures / figure.name, std::move(figure.svg), "<svg", "a figure"});
  return files;
}

std::string printable(const fs::path& path) {
  return io::printable(path.string());
}

/// Options that name a folder do, and those that name a file name none.
void check_options(const ReportOptions& options) {
  struct Named {
    std::string_view option;
    const std::optional<fs::path>& path;
    bool is_folder;
  };
  const std::optional<fs::path> out = options.out;
  for (const auto& [option, path, is_folder] :
       {Named{"--out", out, false}, Named{"--csv", options.csv, true}, Named{"--json", options.json, false},
        Named{"--figures", options.figures, true}}) {
    if (!path) continue;
    if (is_folder && fs::exists(*path) && !fs::is_directory(*path))
      fail(ExitCode::bad_input, "{}: {} is a file: name a folder", option, printable(*path));
    if (!is_folder && (fs::is_directory(*path) || !path->has_filename()))
      fail(ExitCode::bad_input, "{}: {} is a folder: name a file", option, printable(*path));
  }
}

/// Makes the folders, after all files are found to be different ones that may be written there.
void prepare(const std::vector<Output>& files) {
  std::set<fs::path> paths;
  for (const Output& file : files) {
    if (!paths.insert(resolved(file.path)).second)
      fail(ExitCode::bad_input, "{} would be written twice: name different files", printable(file.path));
    if (fs::is_directory(file.path))
      fail(ExitCode::bad_input, "{} is a folder: name another place", printable(file.path));
    check_output(file.path, file.beginning, file.what);
  }
  // A file in the place of a folder that another output needs.
  for (const Output& file : files)
    for (fs::path above = resolved(file.path).parent_path(); above.has_relative_path();
         above = above.parent_path())
      if (paths.contains(above))
        fail(ExitCode::bad_input, "{} would be a file and the folder of {}: name different places",
             printable(above), printable(file.path));
  for (const Output& file : files) io::make_folder(file.path.parent_path());
}

ExitCode make_report(const ReportOptions& options) {
  check_options(options);
  if (experiment::is_run_folder(options.study))
    fail(ExitCode::bad_input,
         "{}: not a study's folder but a run's; for its page, run: amble view {} --static -o {}",
         printable(options.study), io::shell_word(options.study.string()),
         io::shell_word(options.out.string()));
  const auto files = outputs(report::make_report(report::load_study_data(options.study)), options);
  prepare(files);
  for (const Output& file : files) io::write_file(file.path, file.text);
  fmt::print("{}\n", fs::absolute(options.out).lexically_normal().string());
  return ExitCode::ok;
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "report", "Make a page of a study: claims with verdicts, figures, statistics, from its ledger alone");
  auto options = std::make_shared<ReportOptions>();
  command->add_option("DIR", options->study, "Folder of a study")->required();
  command->add_option("-o,--out", options->out, "The page to write (HTML)")->required();
  command->add_option("--csv", options->csv, "Also write all numbers as CSV files into this folder");
  command->add_option("--json", options->json, "Also write them as one JSON document");
  command->add_option("--figures", options->figures,
                      "Also write each figure as an SVG file into this folder");
  add_examples(*command, {{"amble report results/smoke -o report.html", ""},
                          {"amble report results/smoke -o report.html --csv tables --figures figures", ""}});
  command->callback([options, &action] { action = [options] { return make_report(*options); }; });
}

}  // namespace amble::cli
