#include "amble/io/file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "tests/io/child_process.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::io {
namespace {

using test::error_of;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// From now on no file of this process may grow beyond `bytes`: a write fails as on a full disk, with another
/// reason.
void limit_file_size(rlim_t bytes) {
  ::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

/// Gives up the right to override permissions. Only for child processes.
void become_nobody() {
  if (::geteuid() == 0 && (::setgid(65534) != 0 || ::setuid(65534) != 0)) ::_exit(253);
}

TEST(ReadFile, GivesAllBytes) {
  const test::TemporaryFolder folder;
  const std::string bytes = std::string("a\0\r\n\xff", 5) + std::string(3 << 20, 'x');
  EXPECT_EQ(read_file(folder.put("f", bytes)), bytes);
  EXPECT_EQ(read_file(folder.put("empty", "")), "");
}

TEST(ReadFile, SaysWhyItCannot) {
  const test::TemporaryFolder folder;
  const std::string missing = (folder / "no").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { read_file(missing); }), missing + ": No such file or directory");
  EXPECT_EQ(error_of(ExitCode::io, [&] { read_file(folder.path()); }),
            folder.path().string() + ": Is a directory");
  const std::string large = folder.put("large", "12345").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { read_file(large, 4); }), large + ": larger than 4 bytes");
  EXPECT_EQ(read_file(large, 5), "12345");
}

TEST(InputFile, ReadsWhatIsInMemoryAsItReadsAFile) {
  InputFile held("abcdefg", "f");
  EXPECT_EQ(held.read(3), "abc");
  EXPECT_EQ(held.read(0), "");
  EXPECT_EQ(held.read(100), "defg");
  EXPECT_EQ(held.read(1), "");
}

TEST(InputFile, ReadsPieceByPieceUpToTheEnd) {
  const test::TemporaryFolder folder;
  InputFile file(folder.put("f", "abcdefg"));
  EXPECT_EQ(file.read(3), "abc");
  EXPECT_EQ(file.read(0), "");
  EXPECT_EQ(file.read(UINT64_MAX), "defg");
  EXPECT_EQ(file.read(1), "");
}

TEST(LastReadFile, IsTheOneThatThisThreadOpenedLast) {
  const test::TemporaryFolder folder;
  const auto path = folder.put("a", "1");
  read_file(path);
  EXPECT_EQ(last_read_file(), path);
  EXPECT_THROW(read_file(folder / "none"), UserError);
  EXPECT_EQ(last_read_file(), path);
  std::thread([] { EXPECT_EQ(last_read_file(), ""); }).join();
}

TEST(WriteFile, ReplacesTheOldFileAndLeavesNothingElse) {
  const test::TemporaryFolder folder;
  write_file(folder / "f", "old");
  write_file(folder / "f", "new");
  EXPECT_EQ(read_file(folder / "f"), "new");
  EXPECT_THAT(folder.entries(), ElementsAre("f"));
}

TEST(WriteFile, SaysThatTheFolderIsMissing) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "no/f").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { write_file(path, "x"); }),
            "cannot write " + path + ": No such file or directory");
}

TEST(WriteFile, DoesNotReplaceAFolder) {
  const test::TemporaryFolder folder;
  folder.put("taken/f", "x");
  const std::string path = (folder / "taken").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { write_file(path, "x"); }),
            "cannot write " + path + ": Is a directory");
  EXPECT_THAT(folder.entries(), ElementsAre("taken"));
}

TEST(WriteFile, KeepsTheOldFileWhenThereIsNoRoom) {
  const test::TemporaryFolder folder;
  write_file(folder / "f", "old");
  const int status = test::in_child_process([&] {
    limit_file_size(1000);
    const std::string expected = "cannot write " + (folder / "f").string() + ": File too large";
    return error_of(ExitCode::io, [&] { write_file(folder / "f", std::string(2000, 'x')); }) == expected ? 0
                                                                                                         : 1;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_file(folder / "f"), "old");
  EXPECT_THAT(folder.entries(), ElementsAre("f"));
}

TEST(WriteFile, SaysThatTheDiskIsFull) {
  EXPECT_EQ(error_of(ExitCode::io, [] { write_file("/dev/full", "x"); }),
            "cannot write /dev/full: No space left on device");
  struct stat status {};
  ASSERT_EQ(::stat("/dev/full", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode)) << "a device must not be replaced by a file";
}

TEST(WriteFile, SaysThatPermissionIsLackingAndKeepsTheOldFile) {
  const test::TemporaryFolder folder;
  write_file(folder / "f", "old");
  ASSERT_EQ(::chmod(folder.path().c_str(), 0555), 0);
  const int status = test::in_child_process([&] {
    become_nobody();
    const std::string expected = "cannot write " + (folder / "f").string() + ": Permission denied";
    return error_of(ExitCode::io, [&] { write_file(folder / "f", "new"); }) == expected ? 0 : 1;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_file(folder / "f"), "old");
}

TEST(WhyNoFolder, SaysWhatStandsInTheWay) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(why_no_folder(folder.path()), "");
  EXPECT_EQ(why_no_folder(folder / "none"), "no such folder");
  write_file(folder / "f", "x");
  EXPECT_EQ(why_no_folder(folder / "f"), "not a folder");
  std::filesystem::create_directory(folder / "closed");
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  std::filesystem::permissions(folder / "closed", std::filesystem::perms(0));
  const int status = test::in_child_process([&] {
    become_nobody();
    const std::string denied = "Permission denied";
    return why_no_folder(folder / "closed") == denied && why_no_folder(folder / "closed/deep") == denied ? 0
                                                                                                         : 1;
  });
  EXPECT_EQ(status, 0);
}

TEST(AtomicFile, ShowsItselfOnlyWhenCommitted) {
  const test::TemporaryFolder folder;
  {
    AtomicFile file(folder / "f");
    file.write("one ");
    EXPECT_FALSE(std::filesystem::exists(folder / "f"));
    file.write("two");
    file.commit();
    EXPECT_EQ(read_file(folder / "f"), "one two");
  }
  {
    AtomicFile abandoned(folder / "g");
    abandoned.write("x");
    EXPECT_THAT(folder.entries(), UnorderedElementsAre("f", temporary_of("g").string()));
  }
  EXPECT_THAT(folder.entries(), ElementsAre("f"));
}

/// As /dev/stdout is one, whatever the output is redirected to.
TEST(AtomicFile, WritesThroughALinkToAnOpenFileAndLeavesTheLink) {
  const test::TemporaryFolder folder;
  write_file(folder / "taken", "old");
  const int fd = ::open((folder / "taken").c_str(), O_WRONLY);
  ASSERT_GE(fd, 0);
  std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(fd), folder / "out");
  write_file(folder / "out", "new");
  ::close(fd);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "out"));
  EXPECT_EQ(read_file(folder / "taken"), "new");
  // A link to a file is no such thing: it is replaced, and the file stays.
  std::filesystem::create_symlink("taken", folder / "link");
  write_file(folder / "link", "newer");
  EXPECT_EQ(read_file(folder / "taken"), "new");
}

TEST(AtomicFile, ReplacesWhatAKilledProcessOfTheSameNumberLeftBehind) {
  const test::TemporaryFolder folder;
  folder.put(temporary_of("f").string(), "a long remainder");
  write_file(folder / "f", "new");
  EXPECT_EQ(read_file(folder / "f"), "new");
  EXPECT_THAT(folder.entries(), ElementsAre("f"));
}

TEST(DestinationOf, IsKnownOfTemporaryFilesOnly) {
  EXPECT_EQ(destination_of("runs/1/a.json.tmp.4711"), std::filesystem::path("runs/1/a.json"));
  EXPECT_EQ(destination_of("a.tmp.1.tmp.2"), std::filesystem::path("a.tmp.1"));
  EXPECT_EQ(destination_of(temporary_of("runs/1/a.json")), std::filesystem::path("runs/1/a.json"));
  for (const auto* other : {"a.json", "a.json.tmp.", "a.json.tmp.bak", "a.json.tmp.1x", "", "a.tmp.-1"})
    EXPECT_FALSE(destination_of(other)) << other;
}

TEST(AppendFile, GrowsAndCutsOffWhatLiesBeyondTheCheckpoint) {
  const test::TemporaryFolder folder;
  {
    AppendFile log(folder / "log", 0);
    log.append("one\n");
    log.append("two\n");
    EXPECT_EQ(log.size(), 8u);
    EXPECT_EQ(read_file(folder / "log"), "one\ntwo\n");
  }
  AppendFile log(folder / "log", 4);
  EXPECT_EQ(read_file(folder / "log"), "one\n");
  log.append("2\n");
  EXPECT_EQ(read_file(folder / "log"), "one\n2\n");
}

TEST(AppendFile, RefusesAFileThatLacksWhatTheCheckpointSaw) {
  const test::TemporaryFolder folder;
  const std::string path = folder.put("log", "one\n").string();
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { AppendFile(path, 8); }),
            path + ": truncated: it has 4 bytes, 8 were expected");
  EXPECT_EQ(read_file(path), "one\n");
}

TEST(AppendFile, MakesNoFileWhereTheCheckpointSawOne) {
  const test::TemporaryFolder folder;
  const auto path = folder / "log";
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { AppendFile(path, 8); }),
            path.string() + ": missing: 8 bytes were expected");
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(RefuseToReplace, LetsPassWhatIsMissingEmptyOrOfTheSameKind) {
  const test::TemporaryFolder folder;
  const auto path = folder / "out.html";
  refuse_to_replace(path, "<!DOCTYPE", "a page");
  write_file(path, "");
  refuse_to_replace(path, "<!DOCTYPE", "a page");
  write_file(path, "<!DOCTYPE html>");
  refuse_to_replace(path, "<!DOCTYPE", "a page");
  write_file(path, "<!DOC");
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { refuse_to_replace(path, "<!DOCTYPE", "a page"); }),
            path.string() + " exists and is not a page that amble wrote: name another file");
}

TEST(RefuseToReplace, KeepsPagesDrawingsAndScriptsOfOthers) {
  const test::TemporaryFolder folder;
  const auto path = folder / "mine";
  const auto refused = [&](const std::string& text, const std::string& beginning) {
    write_file(path, text);
    try {
      refuse_to_replace(path, beginning, "one");
      return false;
    } catch (const UserError&) {
      return true;
    }
  };
  EXPECT_TRUE(refused("<!DOCTYPE html><title>my home page</title>", "<!DOCTYPE html>"));
  EXPECT_TRUE(refused("<svg xmlns=\"http://www.w3.org/2000/svg\"/>", "<svg"));
  EXPECT_TRUE(refused("#!/bin/bash\nrm -r runs\n", "#!/bin/bash"));
  EXPECT_FALSE(refused("<svg role=\"img\" aria-label=\"a walk\"/>", "<svg"));
}

TEST(CheckOutput, LetsPassWhatWriteOutputCanWriteAndMakesNothing) {
  const test::TemporaryFolder folder;
  const auto path = folder / "new/of/a.svg";
  check_output(path, "<svg", "a drawing");
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
  const std::string drawing = "<svg role=\"img\" aria-label=\"a walk\"/>";
  write_output(path, drawing);
  EXPECT_EQ(read_file(path), drawing);
  check_output(path, "<svg", "a drawing");
  check_output("/dev/null", "<svg", "a drawing");
  const auto below = path / "b.svg", is_folder = folder / "new";
  EXPECT_EQ(error_of(ExitCode::io, [&] { check_output(below, "<svg", "a drawing"); }),
            "cannot write " + below.string() + ": Not a directory");
  EXPECT_EQ(error_of(ExitCode::io, [&] { check_output(is_folder, "<svg", "a drawing"); }),
            "cannot write " + is_folder.string() + ": Is a directory");
}

TEST(AppendFile, LeavesNoHalfLineWhenThereIsNoRoom) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "log").string();
  const int status = test::in_child_process([&] {
    limit_file_size(10);
    AppendFile log(path, 0);
    log.append("1234567\n");
    const std::string message = error_of(ExitCode::io, [&] { log.append("too long\n"); });
    if (message != "cannot write " + path + ": File too large") return 1;
    log.append("9\n");
    return log.size() == 10 ? 0 : 2;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_file(path), "1234567\n9\n");
}

TEST(AppendFile, SaysThatItsFolderIsMissing) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "no/log").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { AppendFile(path, 0); }),
            "cannot write " + path + ": No such file or directory");
}

}  // namespace
}  // namespace amble::io
