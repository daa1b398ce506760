#include "amble/io/lock.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <string>
#include <thread>
#include <vector>

#include "amble/io/file.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::io {
namespace {

using test::error_of;

/// A process that holds the lock of a folder until it is killed.
class Holder {
 public:
  explicit Holder(const std::filesystem::path& folder) {
    std::array<int, 2> ready{};
    EXPECT_EQ(::pipe(ready.data()), 0);
    pid_ = ::fork();
    if (pid_ == 0) {
      const FolderLock lock(folder);
      if (::write(ready[1], "!", 1) == 1) ::pause();
      ::_exit(0);
    }
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Holder() { kill(); }

  void kill() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    pid_ = 0;
  }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = 0;
};

TEST(FolderLock, KeepsAnotherProcessOutAndNamesIt) {
  const test::TemporaryFolder folder;
  const Holder holder(folder.path());
  EXPECT_EQ(error_of(ExitCode::locked, [&] { FolderLock lock(folder.path()); }),
            fmt::format("{} is in use by another process (pid {})", folder.path().string(), holder.pid()));
}

TEST(FolderLock, EndsWithAProcessThatIsKilled) {
  const test::TemporaryFolder folder;
  Holder holder(folder.path());
  holder.kill();
  const FolderLock lock(folder.path());
  EXPECT_EQ(read_file(folder / ".lock"), fmt::format("{}\n", ::getpid()));
}

TEST(FolderLock, KeepsItsOwnProcessOutUntilItsScopeEnds) {
  const test::TemporaryFolder folder;
  { const FolderLock lock(folder.path()); }
  const FolderLock again(folder.path());
  EXPECT_EQ(error_of(ExitCode::locked, [&] { FolderLock third(folder.path()); }),
            fmt::format("{} is in use by this process", folder.path().string()));
}

TEST(FolderLock, SaysThatTheFolderIsMissing) {
  const test::TemporaryFolder folder;
  const std::string missing = (folder / "no").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { FolderLock lock(missing); }),
            "cannot lock " + missing + ": No such file or directory");
}

TEST(FileLock, KeepsAnotherHolderOutAndLeavesTheFileAsItIs) {
  const test::TemporaryFolder folder;
  const auto file = folder / "record.json";
  write_file(file, "{}\n");
  {
    const FileLock lock(file);
    EXPECT_EQ(error_of(ExitCode::locked, [&] { FileLock second(file); }),
              file.string() + " is in use by another process");
  }
  const FileLock again(file);
  EXPECT_EQ(read_file(file), "{}\n");
}

TEST(FileLock, OfAFileThatWasReplacedIsOfTheNewOne) {
  const test::TemporaryFolder folder;
  const auto file = folder / "record.json";
  write_file(file, "old");
  const FileLock old(file);
  write_file(file, "new");
  const FileLock of_new(file);
  EXPECT_EQ(error_of(ExitCode::locked, [&] { FileLock third(file); }),
            file.string() + " is in use by another process");
}

TEST(FileLock, LetsOneAtATimeReplaceTheFile) {
  const test::TemporaryFolder folder;
  const auto file = folder / "count";
  write_file(file, "0");
  constexpr int each = 200;
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i)
    threads.emplace_back([&] {
      for (int done = 0; done < each;) try {
          const FileLock lock(file);
          write_file(file, std::to_string(std::stoi(read_file(file)) + 1));
          ++done;
        } catch (const UserError& error) {
          ASSERT_EQ(error.code(), ExitCode::locked) << error.what();
          std::this_thread::yield();
        }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(read_file(file), std::to_string(3 * each));
}

TEST(FileLock, SaysThatTheFileIsMissingAndMakesNone) {
  const test::TemporaryFolder folder;
  const auto missing = folder / "no";
  EXPECT_EQ(error_of(ExitCode::io, [&] { FileLock lock(missing); }),
            "cannot lock " + missing.string() + ": No such file or directory");
  EXPECT_FALSE(std::filesystem::exists(missing));
}

}  // namespace
}  // namespace amble::io
