#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "amble/ledger/record.hpp"
#include "amble/ledger/study_spec.hpp"

namespace amble::ledger {

/// Where the files of a study are (docs/STUDIES.md).
struct StudyPaths {
  explicit StudyPaths(const std::filesystem::path& folder);
  std::filesystem::path folder, spec, records, runs;

  std::filesystem::path record(std::string_view condition, std::int64_t seed) const;
  std::filesystem::path run(std::string_view condition, std::int64_t seed) const;
};

/// The finished runs of a study: one file each, written once and whole, so that folders from several machines
/// are merged by copying.
class Ledger {
 public:
  explicit Ledger(const StudyPaths& paths) : paths_(paths) {}

  bool has(std::string_view condition, std::int64_t seed) const;
  /// Throws UserError naming the file: missing, truncated, altered, or the record of another run.
  Record load(std::string_view condition, std::int64_t seed) const;
  void save(const Record& record) const;
  /// All records of the study, by condition and seed in the order of the study.
  std::vector<Record> load_all(const StudySpec& study) const;
  /// Files of records of no run of the study, sorted.
  std::vector<std::filesystem::path> unknown_files(const StudySpec& study) const;

 private:
  StudyPaths paths_;
};

/// Hash of the digests of a study's records, in their order, hexadecimal: equal for equal results on any
/// machine, in whatever order tests were added, and whatever tests the study had before.
std::string ledger_digest(const StudySpec& study, const std::vector<Record>& records);

/// The study of a folder, from the copy that `amble study` keeps there. Throws UserError if there is none.
StudySpec load_study_copy(const StudyPaths& paths);
/// Throws UserError if the folder has a study.toml that amble has not written, or another study's records.
/// `file`: from which the study was read.
void check_folder(const StudyPaths& paths, const StudySpec& study, const std::filesystem::path& file);
/// Writes that copy, with paths relative to the folder, unless it is the same already or `file`, from which
/// the study was read. Throws as check_folder(), and then changes nothing.
void keep_study(const StudyPaths& paths, const StudySpec& study, const std::filesystem::path& file = {});

}  // namespace amble::ledger
