#include "amble/ledger/ledger.hpp"

#include <gtest/gtest.h>

#include <filesystem>

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
  const auto digest = ledger_digest(records);
  records[0].provenance.cpu = "another";
  EXPECT_EQ(ledger_digest(records), digest);
  records[0].best_m += 1.0;
  EXPECT_NE(ledger_digest(records), digest);
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
