#include "amble/record/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <limits>

#include "amble/core/hash.hpp"
#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "tests/io/child_process.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/io/mutate.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::record {
namespace {

using test::error_of;
using testing::IsEmpty;

RecordingHeader sample_header() {
  return {0.02,
          {"root.x", "touch.FL", "timer.FL"},
          R"({"name":"quadruped","mass":5.4})",
          R"({"kind":"supg"})",
          "champions/3.json"};
}

std::vector<float> sample_frame(int i) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  return {std::sin(0.1f * static_cast<float>(i)), static_cast<float>(i % 2), i == 300 ? nan : -0.0f};
}

void write_sample(const std::filesystem::path& path, int frames, Outcome outcome = Outcome::fell) {
  RecordingWriter writer(path, sample_header());
  for (int i = 0; i < frames; ++i) writer.add(sample_frame(i));
  writer.finish(outcome);
}

/// Reads to the end; the number of frames.
std::uint64_t read_all(const std::filesystem::path& path) {
  RecordingReader reader(path);
  std::vector<float> frame;
  while (reader.next(frame)) EXPECT_EQ(frame.size(), reader.header().columns.size());
  static_cast<void>(reader.outcome());
  return reader.frames_read();
}

TEST(Recording, ReadsBackWhatWasWrittenToTheBit) {
  const test::TemporaryFolder folder;
  for (const int frames : {0, 1, 255, 256, 257, 512, 1000}) {
    write_sample(folder / "r", frames);
    RecordingReader reader(folder / "r");
    EXPECT_EQ(reader.header().frame_s, 0.02);
    EXPECT_EQ(reader.header().columns, sample_header().columns);
    EXPECT_EQ(reader.header().robot_json, sample_header().robot_json);
    EXPECT_EQ(reader.header().controller_json, sample_header().controller_json);
    EXPECT_EQ(reader.header().origin, "champions/3.json");
    EXPECT_EQ(reader.column("timer.FL"), 2);
    std::vector<float> frame;
    for (int i = 0; i < frames; ++i) {
      ASSERT_TRUE(reader.next(frame));
      const std::vector<float> expected = sample_frame(i);
      ASSERT_EQ(hash_span<float>(frame), hash_span<float>(expected)) << i;
    }
    EXPECT_FALSE(reader.next(frame));
    EXPECT_FALSE(reader.next(frame));
    EXPECT_EQ(reader.outcome(), Outcome::fell);
    EXPECT_EQ(reader.frames_read(), static_cast<std::uint64_t>(frames));
  }
}

TEST(Recording, AppearsOnlyWhenFinished) {
  const test::TemporaryFolder folder;
  {
    RecordingWriter writer(folder / "r", sample_header());
    for (int i = 0; i < 1000; ++i) writer.add(sample_frame(i));
    EXPECT_FALSE(std::filesystem::exists(folder / "r"));
  }
  EXPECT_THAT(folder.entries(), IsEmpty());
}

TEST(Recording, KeepsTheOldOneWhenThereIsNoRoom) {
  const test::TemporaryFolder folder;
  write_sample(folder / "r", 10);
  const int status = test::in_child_process([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{2000, 2000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string expected = "cannot write " + (folder / "r").string() + ": File too large";
    return error_of(ExitCode::io, [&] { write_sample(folder / "r", 100000); }) == expected ? 0 : 1;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_all(folder / "r"), 10u);
  EXPECT_EQ(folder.entries().size(), 1u);
}

TEST(Recording, SaysThatItCannotBeWritten) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "no/r").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { write_sample(path, 1); }),
            "cannot write " + path + ": No such file or directory");
  EXPECT_EQ(error_of(ExitCode::io, [&] { write_sample("/dev/full", 1); }),
            "cannot write /dev/full: No space left on device");
}

TEST(RecordingReader, SaysThatTheFileIsMissingForeignOrOfAnotherVersion) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "r").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { read_all(path); }), path + ": No such file or directory");
  folder.put("r", "{\"format\": \"champion\", \"version\": 1, \"checksum\": \"\"}");
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { read_all(path); }),
            path + ": not a file of this kind: it does not begin with AMBLEREC");
  folder.put("r", io::seal("AMBLEREC", 2, "{}"));
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { read_all(path); }),
            path + ": version 2 of the file format; this program reads version 1");
}

TEST(RecordingReader, NamesAColumnThatIsNotThere) {
  const test::TemporaryFolder folder;
  write_sample(folder / "r", 1);
  const RecordingReader reader(folder / "r");
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { reader.column("root.y"); }),
            (folder / "r").string() + ": no column 'root.y' in the recording");
}

TEST(RecordingReader, DetectsEveryTruncation) {
  const test::TemporaryFolder folder;
  write_sample(folder / "r", 300);
  const std::string bytes = io::read_file(folder / "r"), path = (folder / "t").string();
  const auto header_size = io::sealed_size("AMBLEREC", 1, bytes, "r");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    folder.put("t", bytes.substr(0, size));
    const std::string message = error_of(ExitCode::bad_file, [&] { read_all(path); });
    if (size < io::seal_header_size) {
      ASSERT_EQ(message, fmt::format("{}: truncated: {} bytes are less than the header's 28", path, size));
    } else if (size < header_size) {
      ASSERT_EQ(message, fmt::format("{}: truncated: {} of {} bytes", path, size, header_size));
    } else {
      ASSERT_TRUE(message.starts_with(path + ": truncated: the recording breaks off after ")) << message;
    }
  }
  folder.put("t", bytes.substr(0, bytes.size() - 1));
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { read_all(path); }),
            path + ": truncated: the recording breaks off after 300 frames");
}

TEST(RecordingReader, TellsEveryFlippedByteAndAnythingBehindTheEnd) {
  const test::TemporaryFolder folder;
  write_sample(folder / "r", 300);
  const std::string bytes = io::read_file(folder / "r"), path = (folder / "t").string();
  const auto header_size = io::sealed_size("AMBLEREC", 1, bytes, "r");
  for (std::size_t at = header_size; at < bytes.size(); ++at) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    folder.put("t", flipped);
    const std::string message = error_of(ExitCode::bad_file, [&] { read_all(path); });
    ASSERT_TRUE(message.starts_with(path + ": altered: a checksum does not fit after ") ||
                message.starts_with(path + ": truncated: the recording breaks off after "))
        << at << ": " << message;
  }
  folder.put("t", bytes + '\0');
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { read_all(path); }),
            path + ": altered: a checksum does not fit after 300 frames");
}

TEST(RecordingReader, RefusesSoundlySealedHeadersThatMakeNoSense) {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& json) {
    const auto path = folder.put("r", io::seal("AMBLEREC", 1, json));
    const std::string message = error_of(ExitCode::bad_file, [&] { read_all(path); });
    return message.substr(std::min(message.size(), path.string().size()));
  };
  const std::string rest = R"("robot": {}, "controller": {}, "origin": ""})";
  EXPECT_EQ(refusal(R"({"frame_s": 0.0, "columns": ["a"], )" + rest),
            ": key 'frame_s' must be a time above 0");
  EXPECT_EQ(refusal(R"({"frame_s": "inf", "columns": ["a"], )" + rest),
            ": key 'frame_s' must be a time above 0");
  EXPECT_EQ(refusal(R"({"frame_s": 1, "columns": [], )" + rest),
            ": key 'columns' must be a list of 1 to 4096 names");
  EXPECT_EQ(refusal(R"({"frame_s": 1, "columns": [1], )" + rest), ": key 'columns[0]' must be text");
  EXPECT_EQ(refusal(R"({"frame_s": 1, "columns": ["a"], "robot": 1})"), ": key 'robot' must be an object");
  EXPECT_EQ(refusal(R"({"frame_s": 1, "columns": ["a"], "robot": {}})"), ": key 'controller' is missing");
  EXPECT_EQ(refusal("{\n}}"), ":2:2: not valid JSON: '}'");
}

TEST(Mutation, Recording) {
  const test::TemporaryFolder folder;
  write_sample(folder / "r", 300);
  test::refused_mutations(io::read_file(folder / "r"), 3000, [&](const std::string& bytes) {
    EXPECT_EQ(read_all(folder.put("t", bytes)), 300u) << "what passes the checksums is what was written";
  });
}

TEST(RecordingReader, TakesUpTo4096ColumnsAndFramesOfLessThanABillionSeconds) {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& frame_s, int columns) {
    std::string names;
    for (int i = 0; i < columns; ++i) names += (i == 0 ? "\"c" : ", \"c") + std::to_string(i) + "\"";
    const auto path = folder.put("r", io::seal("AMBLEREC", 1,
                                               "{\"frame_s\": " + frame_s + ", \"columns\": [" + names +
                                                   R"(], "robot": {}, "controller": {}, "origin": ""})"));
    const std::string message = error_of(ExitCode::bad_file, [&] { read_all(path); });
    return message.substr(std::min(message.size(), path.string().size()));
  };
  const std::string sound = ": truncated: the recording breaks off after 0 frames";
  EXPECT_EQ(refusal("0.01", 4096), sound);
  EXPECT_EQ(refusal("0.01", 4097), ": key 'columns' must be a list of 1 to 4096 names");
  EXPECT_EQ(refusal("1e-9", 1), sound);
  EXPECT_EQ(refusal("999999999.0", 1), sound);
  EXPECT_EQ(refusal("1e9", 1), ": key 'frame_s' must be a time above 0");
  EXPECT_EQ(refusal("-1", 1), ": key 'frame_s' must be a time above 0");
}

}  // namespace
}  // namespace amble::record
