#include "amble/watch/watcher.hpp"

#include <algorithm>
#include <exception>
#include <string_view>
#include <system_error>
#include <utility>

#include "amble/core/clock.hpp"
#include "amble/core/error.hpp"
#include "amble/io/background_thread.hpp"
#include "amble/io/file.hpp"
#include "amble/io/text.hpp"
#include "amble/ledger/ledger.hpp"
#include "amble/watch/elite.hpp"

namespace amble::watch {
namespace fs = std::filesystem;
namespace {

using namespace std::chrono_literals;

constexpr auto look_every = 250ms, look_seldom = 1000ms;
constexpr double find_every_s = 2.0, look_at_all_every_s = 1.0;
/// How deep below the folder runs are looked for, and how many are shown.
constexpr int deepest = 3;
constexpr std::size_t most_runs = 2000;
constexpr std::uint64_t most_file_bytes = std::uint64_t{1} << 28;

}  // namespace

Watcher::Watcher(const fs::path& folder) : folder_(folder) {
  if (const std::string why = io::why_no_folder(folder); !why.empty())
    fail(ExitCode::bad_input, "{}: {}; expected a run folder or one with run folders in it",
         io::printable(folder.string()), why);
  look(now_s());
  thread_ = std::thread([this] { work(); });
}

Watcher::~Watcher() {
  end("");
}

void Watcher::end(const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    if (!end_text_) {
      find_due_s_ = look_at_all_due_s_ = 0.0;
      look(now_s());
      end_text_ = text;
    }
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Watcher::work() {
  io::be_background_thread();
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    if (look(now_s())) changed_.notify_all();
    const int before = readers_;
    // A reader that comes is not kept waiting.
    changed_.wait_for(lock, readers_ > 0 ? look_every : look_seldom,
                      [this, before] { return stopping_ || (before == 0 && readers_ > 0); });
  }
}

bool Watcher::look(double now_s) {
  try {
    const std::uint64_t before = version_;
    const bool all = now_s >= look_at_all_due_s_;
    if (all) {
      locks_ = LockHolders::now();
      look_at_all_due_s_ = now_s + look_at_all_every_s;
    }
    std::error_code none;
    const bool gone = !fs::is_directory(folder_, none);
    bool folder_changed = gone != gone_;
    gone_ = gone;
    if (now_s >= find_due_s_) {
      find_due_s_ = now_s + find_every_s;
      folder_changed = find_runs() || folder_changed;
      folder_changed = look_at_study() || folder_changed;
    }
    for (const auto& [id, run] : runs_)
      if ((all || run->reader.summary().stage == Stage::running) && run->reader.poll(locks_, now_s))
        run->version = ++version_;
    if (folder_changed) folder_version_ = ++version_;
    for (auto at = feeds_.begin(); at != feeds_.end();) {
      const auto feed = at->second.lock();
      if (feed && feed->poll(now_s)) ++version_;
      at = feed ? std::next(at) : feeds_.erase(at);
    }
    return version_ != before;
  } catch (const std::exception&) {
    return false;  // of the system, for a file that is being removed; the next look tells
  }
}

bool Watcher::find_runs() {
  const std::size_t before = runs_.size();
  // A folder in which nothing was may become a run.
  if (runs_.empty()) single_ = experiment::is_run_folder(folder_);
  if (single_) {
    add(folder_, ".");
    return runs_.size() != before;
  }
  std::error_code none;
  constexpr auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator at(folder_, options, none), end; at != end && !none;
       at.increment(none)) {
    if (!at->is_directory(none) || at->path().filename().string().starts_with('.')) continue;
    const bool is_run = experiment::is_run_folder(at->path());
    if (is_run || at.depth() + 1 >= deepest) at.disable_recursion_pending();
    if (is_run && runs_.size() < most_runs)
      add(at->path(), at->path().lexically_relative(folder_).generic_string());
  }
  return runs_.size() != before;
}

void Watcher::add(const fs::path& folder, const std::string& id) {
  auto& run = runs_[id];
  if (!run) run = std::make_unique<Followed>(Followed{SummaryReader(folder, id), ++version_});
}

bool Watcher::look_at_study() {
  const ledger::StudyPaths paths(folder_);
  const FileMark study = FileMark::of(paths.spec);
  if (single_ || !study.exists()) return false;
  const auto before = std::pair(planned_, recorded_);
  if (study != study_) {
    study_ = study;
    planned_.reset();
    try {
      int runs = 0;
      const auto spec = ledger::load_study_copy(paths);
      for (const auto& condition : spec.conditions) runs += static_cast<int>(spec.seeds_of(condition).size());
      planned_ = runs;
    } catch (const UserError&) {
      // It is of another version, or no study of amble.
    }
  }
  int records = 0;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(paths.records, none))
    records += entry.path().extension() == ".json";
  recorded_ = records;
  return std::pair(planned_, recorded_) != before;
}

const SummaryReader* Watcher::find(const std::string& id) const {
  const auto found = runs_.find(id);
  return found == runs_.end() ? nullptr : &found->second->reader;
}

io::Json Watcher::folder_json() const {
  const auto or_null = [](const std::optional<int>& value) { return value ? io::Json(*value) : io::Json(); };
  return {{"folder", io::printable(folder_.string())},
          {"gone", gone_},
          {"single", single_},
          {"planned", or_null(planned_)},
          {"recorded", or_null(recorded_)}};
}

std::string Watcher::overview() const {
  const std::lock_guard lock(mutex_);
  io::Json all = folder_json();
  all["runs"] = io::Json::array();
  for (const auto& [id, run] : runs_) all["runs"].push_back(run->reader.summary().json());
  return all.dump(-1, ' ', false, io::Json::error_handler_t::replace);
}

std::string Watcher::champion(const std::string& id, std::optional<int> generation) const {
  std::optional<fs::path> file;
  {
    const std::lock_guard lock(mutex_);
    const SummaryReader* run = find(id);
    if (run == nullptr) return {};
    if (!generation) generation = run->summary().champion;
    if (generation && *generation >= 0) file = run->paths().champion(*generation);
  }
  return file ? read_part(*file, 0, most_file_bytes) : std::string();
}

std::string Watcher::elite(const std::string& id, std::uint32_t cell) const {
  std::optional<experiment::RunPaths> paths;
  {
    const std::lock_guard lock(mutex_);
    if (const SummaryReader* run = find(id)) paths = run->paths();
  }
  const std::lock_guard lock(elite_mutex_);
  return paths ? elite_text(*paths, cell) : std::string();
}

std::string Watcher::table(const std::string& id) const {
  std::optional<fs::path> file;
  {
    const std::lock_guard lock(mutex_);
    if (const SummaryReader* run = find(id)) file = run->paths().generations;
  }
  return file ? read_part(*file, 0, most_file_bytes) : std::string();
}

std::string Watcher::curves() {
  std::map<std::string, fs::path> tables;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, run] : runs_) tables.emplace(id, run->reader.paths().generations);
  }
  // Not under the other lock: many tables take long when they are read first.
  const std::lock_guard lock(curves_mutex_);
  return curves_.json(tables).dump(-1, ' ', false, io::Json::error_handler_t::replace);
}

int Watcher::readers() const {
  const std::lock_guard lock(mutex_);
  return readers_;
}

std::vector<Summary> Watcher::summaries() const {
  const std::lock_guard lock(mutex_);
  std::vector<Summary> all;
  for (const auto& [id, run] : runs_) all.push_back(run->reader.summary());
  return all;
}

bool Watcher::is_gone() const {
  const std::lock_guard lock(mutex_);
  return gone_;
}

std::unique_ptr<Watcher::Reader> Watcher::read(const std::string& id) {
  std::unique_ptr<Reader> reader;
  {
    const std::lock_guard lock(mutex_);
    reader.reset(new Reader(*this, id));
    ++readers_;
  }
  changed_.notify_all();
  return reader;
}

std::shared_ptr<Feed> Watcher::feed_of(const std::string& id) {
  const SummaryReader* run = find(id);
  if (run == nullptr) return nullptr;
  auto feed = feeds_[id].lock();
  if (feed) return feed;
  feeds_[id] = feed = std::make_shared<Feed>(run->paths());
  if (end_text_) feed->poll(now_s());
  return feed;
}

}  // namespace amble::watch
