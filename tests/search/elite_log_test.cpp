#include "amble/search/elite_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::search {
namespace {

constexpr std::uint32_t log_cells = 5;

std::string log_header(std::uint32_t version = 1, std::uint32_t cells = log_cells,
                       std::uint32_t dimensions = 1) {
  io::BinaryWriter writer;
  writer.put(version);
  writer.put(cells);
  writer.put(dimensions);
  return "AMBLEMAP" + writer.bytes();
}

/// A file of these records, each followed by the checksum that fits.
std::string log_of(const std::vector<std::string>& records) {
  std::string file = log_header();
  std::uint64_t checksum = 0;
  for (const std::string& record : records) {
    checksum = hash_bytes(record.data(), record.size(), checksum);
    io::BinaryWriter length, end;
    length.put(static_cast<std::uint32_t>(record.size()));
    end.put(checksum);
    file += length.bytes() + record + end.bytes();
  }
  return file;
}

std::string put_record(std::uint32_t cell, double objective = 1.0, float descriptor = 0.5f) {
  io::BinaryWriter record;
  record.put(std::uint8_t{0});
  record.put(cell);
  record.put(std::uint32_t{3});  // evaluations
  record.put(objective);
  record.put(descriptor);
  record.put(std::uint32_t{7});  // round
  record.put(std::uint32_t{9});  // candidate
  record.put_text("genome");
  return record.bytes();
}

std::string update_record(std::uint32_t cell, double objective = 2.0, float descriptor = 0.25f) {
  io::BinaryWriter record;
  record.put(std::uint8_t{1});
  record.put(cell);
  record.put(std::uint32_t{4});
  record.put(objective);
  record.put(descriptor);
  return record.bytes();
}

std::string remove_record(std::uint32_t cell) {
  io::BinaryWriter record;
  record.put(std::uint8_t{2});
  record.put(cell);
  return record.bytes();
}

/// The message of the UserError; "" if the file is read.
std::string log_refusal(const std::string& bytes) {
  const test::TemporaryFolder folder;
  io::InputFile file(folder.put("archive.bin", bytes));
  try {
    read_elites(file, "archive.bin", log_cells, 1);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_file);
    return error.what();
  }
  return "";
}

TEST(EliteLog, GivesEachNumberOfAnEliteBack) {
  const test::TemporaryFolder folder;
  io::InputFile file(folder.put("archive.bin", log_of({put_record(4), put_record(0), update_record(0)})));
  const Elites elites = read_elites(file, "archive.bin", log_cells, 1);
  ASSERT_EQ(elites.size(), 2u);
  const Elite& last = elites[elites.in(4)];
  EXPECT_EQ(last.cell, 4u);
  EXPECT_EQ(last.evaluations, 3u);
  EXPECT_EQ(last.objective, 1.0);
  EXPECT_EQ(last.round, 7u);
  EXPECT_EQ(last.candidate, 9u);
  EXPECT_EQ(last.genome, "genome");
  EXPECT_EQ(elites.descriptor(elites.in(4))[0], 0.5f);
  const Elite& first = elites[elites.in(0)];
  EXPECT_EQ(first.evaluations, 4u);
  EXPECT_EQ(first.objective, 2.0);
  EXPECT_EQ(first.round, 7u) << "an update leaves what the elite is";
  EXPECT_EQ(elites.descriptor(elites.in(0))[0], 0.25f);
}

TEST(EliteLog, RefusesChangesThatCannotBeThoughTheirChecksumsFit) {
  const auto says = [](const std::vector<std::string>& records, const char* part) {
    return log_refusal(log_of(records)).find(part) != std::string::npos;
  };
  EXPECT_EQ(log_refusal(log_of({put_record(4), remove_record(4)})), "");
  EXPECT_TRUE(says({put_record(5)}, "a cell that the map does not have"));
  EXPECT_TRUE(says({put_record(1), remove_record(2)}, "a change of an empty cell"));
  EXPECT_TRUE(says({put_record(1), update_record(2)}, "a change of an empty cell"));
  EXPECT_TRUE(says({put_record(1), remove_record(1), remove_record(1)}, "a change of an empty cell"));
  for (const double objective : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_TRUE(says({put_record(1, objective)}, "an objective is not finite"));
    EXPECT_TRUE(says({put_record(1), update_record(1, objective)}, "an objective is not finite"));
  }
  for (const float descriptor : {HUGE_VALF, -HUGE_VALF, std::nanf("")}) {
    EXPECT_TRUE(says({put_record(1, 1.0, descriptor)}, "a descriptor is not finite"));
    EXPECT_TRUE(says({put_record(1), update_record(1, 1.0, descriptor)}, "a descriptor is not finite"));
  }
  EXPECT_TRUE(says({put_record(1) + "x"}, "more bytes than expected"));
  std::string unknown = remove_record(1);
  unknown[0] = 3;
  EXPECT_TRUE(says({put_record(1), unknown}, "unknown enum value"));
}

TEST(EliteLog, RefusesRecordsOfMoreThanAHundredMillionBytes) {
  const auto with_length = [](std::uint32_t length) {
    io::BinaryWriter writer;
    writer.put(length);
    return log_refusal(log_header() + writer.bytes());
  };
  EXPECT_EQ(with_length(100'000'000), "") << "cut off, which is no defect";
  EXPECT_EQ(with_length(100'000'001), "archive.bin: altered: a record of 100000001 bytes");
}

TEST(EliteLog, RefusesTheHeaderOfAnotherMap) {
  EXPECT_EQ(log_refusal(log_header()), "");
  EXPECT_EQ(log_refusal(log_header(3)),
            "archive.bin: version 3 of the file format; this program reads versions 1 and 2");
  EXPECT_EQ(log_refusal(log_header(1, 6)),
            "archive.bin: a map of 6 cells in 1 dimensions, this run's has 5 in 1");
  EXPECT_EQ(log_refusal(log_header(1, log_cells, 2)),
            "archive.bin: a map of 5 cells in 2 dimensions, this run's has 5 in 1");
  EXPECT_EQ(log_refusal(log_header().substr(0, 19)),
            "archive.bin: truncated: 19 bytes are less than the header's 20");
  EXPECT_EQ(log_refusal("AMBLEMAX" + log_header().substr(8)),
            "archive.bin: not a file of this kind: it does not begin with AMBLEMAP");
}

}  // namespace
}  // namespace amble::search
