#include "amble/io/lock.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

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

TEST(FolderLock, EndsWithItsScope) {
  const test::TemporaryFolder folder;
  { const FolderLock lock(folder.path()); }
  const FolderLock again(folder.path());
  EXPECT_EQ(error_of(ExitCode::locked, [&] { FolderLock third(folder.path()); }),
            fmt::format("{} is in use by another process (pid {})", folder.path().string(), ::getpid()));
}

TEST(FolderLock, SaysThatTheFolderIsMissing) {
  const test::TemporaryFolder folder;
  const std::string missing = (folder / "no").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { FolderLock lock(missing); }),
            "cannot lock " + missing + ": No such file or directory");
}

}  // namespace
}  // namespace amble::io
