#include "tests/cli/process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace amble::tests {
namespace {

std::filesystem::path scratch_name() {
  static int count = 0;
  return std::filesystem::temp_directory_path() /
         ("amble-test-" + std::to_string(getpid()) + "-" + std::to_string(count++));
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, bool leads_group)
    : out_(scratch_name()), err_(scratch_name()) {
  std::vector<char*> argv{const_cast<char*>(AMBLE_PROGRAM)};
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) {
    if (leads_group) setpgid(0, 0);
    dup2(open(out_.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err_.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), STDERR_FILENO);
    execv(AMBLE_PROGRAM, argv.data());
    _exit(127);
  }
  // Whichever of the two is first: the group is there from now on.
  if (leads_group) setpgid(pid_, pid_);
}

Process::~Process() {
  if (!waited_) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  std::error_code none;
  std::filesystem::remove(out_, none);
  std::filesystem::remove(err_, none);
}

void Process::signal(int number) const {
  kill(pid_, number);
}

void Process::signal_group(int number) const {
  kill(-pid_, number);
}

bool Process::running() const {
  siginfo_t ended{};
  return waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         ended.si_pid == 0;
}

Finished Process::wait() {
  int status = 0;
  rusage used{};
  wait4(pid_, &status, 0, &used);
  waited_ = true;
  Finished finished{.out = slurp(out_),
                    .err = slurp(err_),
                    .peak_memory_bytes = 1024.0 * static_cast<double>(used.ru_maxrss)};
  if (WIFEXITED(status)) finished.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) finished.signal = WTERMSIG(status);
  return finished;
}

Finished amble(const std::vector<std::string>& arguments) {
  return Process(arguments).wait();
}

std::string slurp(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void spill(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string without_times(const std::string& csv) {
  const std::string header = csv.substr(0, csv.find('\n'));
  const auto times =
      std::count(header.begin() + static_cast<std::ptrdiff_t>(header.find(",wall_s")), header.end(), ',');
  std::istringstream lines(csv);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    for (int i = 0; i < times; ++i) line.resize(std::min(line.size(), line.rfind(',')));
    kept += line + "\n";
  }
  return kept;
}

std::string all_champions(const std::filesystem::path& run) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(run / "champions"))
    if (entry.path().extension() == ".json") files.push_back(entry.path());  // no remains of a kill -9
  std::ranges::sort(files);
  std::string all;
  for (const auto& file : files) all += file.filename().string() + "\n" + slurp(file);
  return all;
}

}  // namespace amble::tests
