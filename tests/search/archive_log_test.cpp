#include "amble/search/archive_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/search/novelty.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/search/samples.hpp"

namespace amble::search {
namespace {

using testing::HasSubstr;

constexpr std::size_t length = 6, header_bytes = 16, record_bytes = length * 4 + 8;

class ArchiveFile : public testing::Test {
 protected:
  NoveltySettings settings() const {
    NoveltySettings settings;
    settings.threshold = 20.0;
    settings.archive_limit = 100;
    return settings;
  }

  /// Judges some generations, and appends to the file's bytes after each.
  void run(NoveltySearch& search, std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t generation = from; generation < to; ++generation) {
      Stream stream(1, Purpose::test, generation);
      const auto rows = random_rows(Shape::normal, 12, length, stream);
      for (const auto& fitness : search.fitness_of(evaluations(rows)))
        novelties_.push_back(fitness.selection);
      file_ += search.take_archive_growth();
    }
  }

  std::string checkpoint(const NoveltySearch& search) const {
    io::BinaryWriter writer;
    search.save(writer);
    return writer.bytes();
  }

  /// What load() and restore_archive() do with these bytes.
  std::uint64_t restore(NoveltySearch& search, const std::string& checkpoint,
                        const std::string& bytes) const {
    io::BinaryReader reader(checkpoint, "checkpoint.bin");
    search.load(reader);
    reader.finish();
    io::InputFile file(folder_.put("archive.bin", bytes));
    return search.restore_archive(file, "archive.bin");
  }

  /// The message of the UserError; "" if all is well.
  std::string error_of(const std::string& checkpoint, const std::string& bytes) const {
    NoveltySearch search(settings(), length);
    try {
      restore(search, checkpoint, bytes);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_file);
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
  std::string file_;
  std::vector<double> novelties_;
};

TEST_F(ArchiveFile, GoesOnToTheSameBitsAsIfNothingHadHappened) {
  NoveltySearch whole(settings(), length);
  run(whole, 0, 8);
  const auto whole_file = std::exchange(file_, "");
  const auto whole_novelties = std::exchange(novelties_, {});

  NoveltySearch first(settings(), length);
  run(first, 0, 3);
  const auto saved = checkpoint(first);
  // Killed after the archive of another generation was written, before its checkpoint was.
  auto ahead = file_;
  ahead += "half a record";
  NoveltySearch second(settings(), length);
  EXPECT_EQ(restore(second, saved, ahead), file_.size());
  run(second, 3, 8);
  EXPECT_EQ(file_, whole_file);
  EXPECT_EQ(novelties_, whole_novelties);
  EXPECT_EQ(checkpoint(second), checkpoint(whole));
  EXPECT_GT(whole.archive().rows(), 20u) << "the test should see an archive that grows";
}

TEST_F(ArchiveFile, HoldsAHeaderAndOneRecordPerMember) {
  NoveltySearch search(settings(), length);
  run(search, 0, 2);
  EXPECT_EQ(file_.size(), header_bytes + search.archive().rows() * record_bytes);
  EXPECT_EQ(search.take_archive_growth(), "");
}

TEST_F(ArchiveFile, MayBeEmptyButForItsHeader) {
  NoveltySearch search(settings(), length);
  file_ = search.take_archive_growth();
  EXPECT_EQ(file_.size(), header_bytes);
  NoveltySearch again(settings(), length);
  EXPECT_EQ(restore(again, checkpoint(search), file_), header_bytes);
  EXPECT_EQ(again.take_archive_growth(), "");
}

TEST_F(ArchiveFile, IsRefusedWhenTruncatedAnywhere) {
  NoveltySearch search(settings(), length);
  run(search, 0, 2);
  const auto saved = checkpoint(search);
  for (std::size_t size = 0; size < file_.size(); ++size)
    ASSERT_THAT(error_of(saved, file_.substr(0, size)), HasSubstr("archive.bin: truncated")) << size;
}

TEST_F(ArchiveFile, IsRefusedWhenAnyByteIsAltered) {
  NoveltySearch search(settings(), length);
  run(search, 0, 2);
  const auto saved = checkpoint(search);
  for (std::size_t at = 0; at < file_.size(); ++at) {
    auto altered = file_;
    altered[at] = static_cast<char>(altered[at] ^ 0x40);
    ASSERT_THAT(error_of(saved, altered), testing::StartsWith("archive.bin: ")) << at;
  }
}

TEST_F(ArchiveFile, IsRefusedWhenMembersChangedPlaces) {
  NoveltySearch search(settings(), length);
  run(search, 0, 2);
  auto swapped = file_;
  std::swap_ranges(swapped.begin() + header_bytes, swapped.begin() + header_bytes + record_bytes,
                   swapped.begin() + header_bytes + record_bytes);
  EXPECT_EQ(error_of(checkpoint(search), swapped),
            "archive.bin: altered: the checksum of member 0 does not fit");
}

TEST_F(ArchiveFile, OfAnotherRunIsRefused) {
  NoveltySearch search(settings(), length), other(settings(), length), longer(settings(), length + 2);
  run(search, 0, 2);
  const auto saved = checkpoint(search);
  file_.clear();
  run(other, 7, 12);
  EXPECT_EQ(error_of(saved, file_), "archive.bin: not the archive that the checkpoint was written with");
  EXPECT_EQ(error_of(saved, longer.take_archive_growth()),
            "archive.bin: behaviours of 8 numbers, this run's have 6");
}

TEST_F(ArchiveFile, OfAnotherKindOrVersionIsRefused) {
  NoveltySearch search(settings(), length);
  run(search, 0, 1);
  const auto saved = checkpoint(search);
  EXPECT_EQ(error_of(saved, "generation,best_m\n"),
            "archive.bin: not a file of this kind: it does not begin with AMBLEARC");
  auto newer = file_;
  newer[8] = 9;
  EXPECT_EQ(error_of(saved, newer),
            "archive.bin: version 9 of the file format; this program reads version 1");
}

TEST_F(ArchiveFile, AndStateThrowNothingButUserErrorsUnderRandomDamage) {
  NoveltySearch search(settings(), length);
  run(search, 0, 2);
  const auto saved = checkpoint(search);
  for (std::uint32_t round = 0; round < 500; ++round) {
    Stream stream(2, Purpose::test, 0, round);
    auto state = saved, bytes = file_;
    auto& damaged = stream.chance(0.5) ? state : bytes;
    for (std::uint32_t i = 0; i < 1 + stream.below(4); ++i)
      damaged[stream.below(static_cast<std::uint32_t>(damaged.size()))] =
          static_cast<char>(stream.below(256));
    error_of(state, bytes);
  }
}

TEST_F(ArchiveFile, CannotHoldMoreMembersThanTheSettingsAllow) {
  NoveltySearch search(settings(), length);
  run(search, 0, 2);
  const int members = static_cast<int>((file_.size() - header_bytes) / record_bytes);
  ASSERT_GT(members, 3);
  auto small = settings();
  for (small.archive_limit = members - 3; small.archive_limit <= members + 1; ++small.archive_limit) {
    NoveltySearch again(small, length);
    if (small.archive_limit < members)
      EXPECT_THROW(restore(again, checkpoint(search), file_), UserError) << small.archive_limit;
    else
      EXPECT_NO_THROW(restore(again, checkpoint(search), file_)) << small.archive_limit;
  }
}

TEST_F(ArchiveFile, OfWhichANumberIsNotFiniteIsRefusedThoughItsChecksumsFit) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    NoveltySearch search(settings(), length);
    file_.clear();
    run(search, 0, 2);
    // The last member's last number, with the checksum that follows from the member before it.
    const std::size_t last = file_.size() - record_bytes;
    std::uint64_t before = 0;
    std::memcpy(&before, file_.data() + last - 8, 8);
    std::vector<float> row(length);
    std::memcpy(row.data(), file_.data() + last, 4 * length);
    row.back() = bad;
    const std::uint64_t checksum = hash_span(std::span<const float>(row), before);
    std::string bytes = file_;
    std::memcpy(bytes.data() + last, row.data(), 4 * length);
    std::memcpy(bytes.data() + last + 4 * length, &checksum, 8);
    // The checkpoint's own copy of it stands where the old one stood.
    std::string state = checkpoint(search);
    const std::size_t at = state.find(file_.substr(file_.size() - 8));
    ASSERT_NE(at, std::string::npos);
    std::memcpy(state.data() + at, &checksum, 8);
    EXPECT_NE(error_of(state, bytes).find("altered"), std::string::npos) << error_of(state, bytes);
  }
}

}  // namespace
}  // namespace amble::search
