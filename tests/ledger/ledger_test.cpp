#include "amble/ledger/ledger.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/ledger/samples.hpp"

namespace amble::ledger {
namespace {

using test::TemporaryFolder;

StudySpec sample_study() {
  StudySpec study;
  study.seeds = {7, 8};
  for (const char* name : {"supg", "sine"}) study.conditions.emplace_back().name = name;
  return study;
}

TEST(Ledger, RecordsOfTwoFoldersAreMergedByCopying) {
  const TemporaryFolder first, second;
  const StudyPaths one(first.path()), two(second.path());
  Ledger(one).save(sample_record("supg", 7));
  Ledger(one).save(sample_record("sine", 8));
  Ledger(two).save(sample_record("supg", 8));
  std::filesystem::copy(two.records, one.records, std::filesystem::copy_options::recursive);
  const auto records = Ledger(one).load_all(sample_study());
  ASSERT_EQ(records.size(), 3u);
  EXPECT_EQ(records[0].condition, "supg");
  EXPECT_EQ(records[1].seed, 8);
  EXPECT_EQ(records[2].condition, "sine");
}

TEST(Ledger, DigestDependsOnResultsAlone) {
  auto records = std::vector{sample_record("supg", 7), sample_record("sine", 8)};
  const auto digest = ledger_digest(sample_study(), records);
  records[0].provenance.cpu = "another";
  EXPECT_EQ(ledger_digest(sample_study(), records), digest);
  records[0].best_objective += 1.0;
  EXPECT_NE(ledger_digest(sample_study(), records), digest);
}

TEST(Ledger, DigestIsOfTheTestsThatTheStudyHasInWhateverOrderTheyWereAdded) {
  auto study = sample_study();
  for (const char* name : {"first", "second"}) study.tests.emplace_back().name = name;
  auto records = std::vector{sample_record("supg", 7)};
  records[0].tests.resize(2, records[0].tests.at(0));
  records[0].tests[0].name = "first";
  records[0].tests[1].name = "second";
  const auto digest = ledger_digest(study, records);
  std::swap(records[0].tests[0], records[0].tests[1]);
  records[0].study = "before it was renamed";
  EXPECT_EQ(ledger_digest(study, records), digest);
  records[0].tests.push_back(records[0].tests[0]);
  records[0].tests[2].name = "of an earlier study file";
  EXPECT_EQ(ledger_digest(study, records), digest);
  study.tests[1].conditions = {"sine"};
  EXPECT_NE(ledger_digest(study, records), digest);
  records[0].tests[0].episodes.at(0).distance_m += 1.0;  // "second", which is not of supg any more
  const auto narrowed = ledger_digest(study, records);
  records[0].tests[0].episodes.at(0).distance_m += 1.0;
  EXPECT_EQ(ledger_digest(study, records), narrowed);
}

TEST(Ledger, RecordUnderAnotherNameIsRefused) {
  const TemporaryFolder folder;
  const StudyPaths paths(folder.path());
  Ledger(paths).save(sample_record("supg", 7));
  std::filesystem::rename(paths.record("supg", 7), paths.record("supg", 8));
  EXPECT_THROW(Ledger(paths).load("supg", 8), UserError);
}

TEST(Ledger, FilesOfNoRunOfTheStudyAreNamed) {
  const TemporaryFolder folder;
  const StudyPaths paths(folder.path());
  Ledger(paths).save(sample_record("supg", 7));
  Ledger(paths).save(sample_record("supg", 99));
  const auto unknown_files = Ledger(paths).unknown_files(sample_study());
  ASSERT_EQ(unknown_files.size(), 1u);
  EXPECT_EQ(unknown_files[0], paths.record("supg", 99));
  EXPECT_EQ(Ledger(paths).load_all(sample_study()).size(), 1u);
}

TEST(KeptStudy, TakesThePlaceOfNothingThatIsNotItsOwn) {
  const TemporaryFolder folder;
  const StudyPaths paths(folder / "s");
  StudySpec study = sample_study();
  study.name = "mine";
  study.generations = 3;
  for (ConditionSpec& condition : study.conditions) condition.config = "supg.toml";
  const auto refusal = [&] {
    const auto before = io::read_file(paths.spec);
    try {
      keep_study(paths, study);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input);
      EXPECT_EQ(io::read_file(paths.spec), before);
      return std::string(error.what());
    }
    return std::string();
  };
  std::filesystem::create_directories(paths.folder);
  io::write_file(paths.spec, "my = 'own'\n");
  EXPECT_NE(refusal().find("is not a study that amble keeps there"), std::string::npos);

  std::filesystem::remove(paths.spec);
  keep_study(paths, study);
  Ledger(paths).save(sample_record("supg", 7));
  study.name = "renamed";
  EXPECT_EQ(refusal(), "") << "its records are of this study, too";
  Ledger(paths).save(sample_record("supg", 99));
  study.name = "another";
  EXPECT_NE(refusal().find("has the study 'renamed'"), std::string::npos);
  EXPECT_THROW(check_folder(paths, study, {}), UserError)
      << "so that nobody is told how far another study is";
  EXPECT_NO_THROW(check_folder(StudyPaths(folder / "new"), study, {}));
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
}

TEST(KeptStudy, IsLeftAsItIsWhereTheStudyWasReadFromIt) {
  const TemporaryFolder folder;
  const StudyPaths paths(folder.path());
  io::write_file(paths.spec, "# by hand\n");
  keep_study(paths, sample_study(), folder / "study.toml");
  EXPECT_EQ(io::read_file(paths.spec), "# by hand\n");
}

TEST(KeptStudy, FindsItsFilesThroughALinkToItsFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "deep/er/s");
  std::filesystem::create_directory_symlink(folder / "deep/er/s", folder / "link");
  io::write_file(folder / "supg.toml", "name = \"found\"\n");
  StudySpec study = sample_study();
  study.name = "linked";
  study.generations = 3;
  for (ConditionSpec& condition : study.conditions) condition.config = (folder / "supg.toml").string();
  const StudyPaths paths(folder / "link");
  keep_study(paths, study);
  EXPECT_EQ(io::read_file(load_study(paths.spec).conditions[0].config), "name = \"found\"\n");
}

TEST(KeptStudy, NamesTheSameFilesAsTheOriginalWhereverItsFolderIs) {
  const TemporaryFolder folder;
  StudySpec study = sample_study();
  study.name = "kept";
  study.generations = 3;
  const auto file = [&](const char* name) { return (folder / "studies" / name).string(); };
  for (ConditionSpec& condition : study.conditions) condition.config = file("supg.toml");
  study.conditions[1].robot = file("robot.toml");
  TestSpec& test = study.tests.emplace_back();
  test.name = "hurt";
  test.noise = file("noise.toml");
  test.ground = file("ground.toml");
  test.damage = file("damage.toml");
  const StudyPaths paths(folder / "results/kept");
  keep_study(paths, study);
  const StudySpec kept = load_study(paths.spec);
  EXPECT_EQ(kept.conditions[0].config, study.conditions[0].config);
  EXPECT_EQ(kept.conditions[1].robot, study.conditions[1].robot);
  EXPECT_EQ(kept.tests[0].noise, test.noise);
  EXPECT_EQ(kept.tests[0].ground, test.ground);
  EXPECT_EQ(kept.tests[0].damage, test.damage);
}

}  // namespace
}  // namespace amble::ledger
