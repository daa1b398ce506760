#include "amble/ledger/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"

namespace amble::ledger {
namespace fs = std::filesystem;

StudyPaths::StudyPaths(const fs::path& folder_in)
    : folder(folder_in), spec(folder / "study.toml"), records(folder / "ledger"), runs(folder / "runs") {}

fs::path StudyPaths::record(std::string_view condition, std::int64_t seed) const {
  return records / fmt::format("{}-{:03}.json", condition, seed);
}

fs::path StudyPaths::run(std::string_view condition, std::int64_t seed) const {
  return runs / fmt::format("{}-{:03}", condition, seed);
}

bool Ledger::has(std::string_view condition, std::int64_t seed) const {
  return fs::exists(paths_.record(condition, seed));
}

Record Ledger::load(std::string_view condition, std::int64_t seed) const {
  const fs::path path = paths_.record(condition, seed);
  const std::string text = io::read_file(path);
  Record record;
  try {
    record = parse_record(text, path.string());
  } catch (const UserError& error) {
    fail(error.code(), "{}; if it cannot be restored, move it away: `amble study` then makes that run again",
         error.what());
  }
  if (record.condition != condition || record.seed != seed)
    fail(ExitCode::bad_file,
         "{}: the record of {} with seed {}, under another name; name it so, or move it away", path.string(),
         record.condition, record.seed);
  return record;
}

void Ledger::save(const Record& record) const {
  io::make_folder(paths_.records);
  io::write_file(paths_.record(record.condition, record.seed), record_text(record));
}

std::vector<Record> Ledger::load_all(const StudySpec& study) const {
  std::vector<Record> records;
  for (const ConditionSpec& condition : study.conditions)
    for (const std::int64_t seed : study.seeds_of(condition))
      if (has(condition.name, seed)) records.push_back(load(condition.name, seed));
  return records;
}

std::vector<fs::path> Ledger::unknown_files(const StudySpec& study) const {
  std::set<fs::path> own;
  for (const ConditionSpec& condition : study.conditions)
    for (const std::int64_t seed : study.seeds_of(condition)) own.insert(paths_.record(condition.name, seed));
  std::vector<fs::path> others;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(paths_.records, none))
    if (entry.path().extension() == ".json" && !own.contains(entry.path())) others.push_back(entry.path());
  std::ranges::sort(others);
  return others;
}

std::string ledger_digest(const StudySpec& study, const std::vector<Record>& records) {
  std::string digests;
  for (Record record : records) {
    record.study = study.name;
    std::vector<TestResult> tests;
    for (const TestSpec& test : study.tests)
      if (const auto* const result = record.find_test(test.name); result && test.applies_to(record.condition))
        tests.push_back(*result);
    record.tests = std::move(tests);
    digests += record.digest();
  }
  return hex(hash_text(digests));
}

StudySpec load_study_copy(const StudyPaths& paths) {
  if (const std::string why = io::why_no_folder(paths.folder); !why.empty())
    fail(ExitCode::io, "{}: {}", paths.folder.string(), why);
  if (!fs::exists(paths.spec))
    fail(ExitCode::bad_input,
         "{}: not a study (study.toml is missing); to make one, run: amble study FILE --out {}",
         paths.folder.string(), io::shell_word(paths.folder.string()));
  return load_study(paths.spec, true);
}

namespace {

/// Throws UserError unless what is in the place of the kept study may give way to `text`.
void check_place(const StudyPaths& paths, const StudySpec& study, const std::string& text) {
  io::refuse_to_replace(paths.spec, text.substr(0, text.find('\n')), "a study that amble keeps there");
  const auto strangers = Ledger(paths).unknown_files(study);
  if (strangers.empty()) return;
  const StudySpec other = load_study(paths.spec, true);
  if (other.name != study.name)
    fail(ExitCode::bad_input,
         "--out {}: has the study '{}', and records of it that are not of '{}'; name another folder",
         paths.folder.string(), other.name, study.name);
}

/// Throws UserError for a folder that has folders of other kinds in it: one of several studies, or of
/// sources.
void refuse_foreign_folder(const StudyPaths& paths) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(paths.folder, none)) {
    const fs::path& found = entry.path();
    if (entry.is_directory(none) && found != paths.records && found != paths.runs)
      fail(ExitCode::bad_input,
           "--out {}: is no study's folder, and has others in it, as {}; name another one, e.g. {}",
           paths.folder.string(), found.filename().string(), (paths.folder / "my-study").string());
  }
}

/// A study as its folder keeps it, paths from there.
std::string kept_text(const StudyPaths& paths, StudySpec kept) {
  const auto from_folder = [&paths](std::string& named) {
    if (!named.empty()) named = fs::proximate(named, paths.folder).string();
  };
  for (ConditionSpec& condition : kept.conditions) {
    from_folder(condition.config);
    from_folder(condition.robot);
  }
  for (TestSpec& test : kept.tests) {
    from_folder(test.noise);
    from_folder(test.ground);
    from_folder(test.damage);
  }
  return kept.to_toml();
}

/// Whether this file is the copy that the folder keeps.
bool is_kept_copy(const StudyPaths& paths, const fs::path& file) {
  std::error_code missing;
  return fs::equivalent(file, paths.spec, missing);
}

}  // namespace

void check_folder(const StudyPaths& paths, const StudySpec& study, const fs::path& file) {
  if (is_kept_copy(paths, file)) return;
  if (!fs::exists(paths.spec)) return refuse_foreign_folder(paths);
  const std::string text = kept_text(paths, study);
  if (io::read_file(paths.spec) != text) check_place(paths, study, text);
}

void keep_study(const StudyPaths& paths, const StudySpec& study, const fs::path& file) {
  check_folder(paths, study, file);
  if (is_kept_copy(paths, file)) return;
  const std::string text = kept_text(paths, study);
  if (fs::exists(paths.spec) && io::read_file(paths.spec) == text) return;
  io::make_folder(paths.folder);
  io::write_file(paths.spec, text);
}

}  // namespace amble::ledger
