#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "amble/watch/curves.hpp"
#include "amble/watch/feed.hpp"
#include "amble/watch/run_summary.hpp"

namespace amble::watch {

/// Follows a run folder, or all run folders below a folder such as a study's, by their files alone: it
/// neither locks nor writes anything. One thread, of low priority, looks at them: four times a second while
/// somebody reads, else once. However many read, each file is read once.
class Watcher {
 public:
  class Reader;

  /// Throws UserError if there is no such folder.
  explicit Watcher(const std::filesystem::path& folder);
  ~Watcher();
  Watcher(const Watcher&) = delete;
  Watcher& operator=(const Watcher&) = delete;

  /// {"folder": its name, "gone": whether it has vanished, "single": whether it is a run itself, "planned",
  /// "recorded": of a study, its runs and those with a record, else null, "runs": [Summary::json(), …]}.
  std::string overview() const;
  /// The text of a run's champion's file: of a generation, or of the latest; empty if there is none.
  std::string champion(const std::string& id, std::optional<int> generation) const;
  /// The text of the champion's file of the elite in a cell of a run's map (elite_text); one at a time.
  std::string elite(const std::string& id, std::uint32_t cell) const;
  /// The text of a run's generations.csv; empty if there is none.
  std::string table(const std::string& id) const;

  /// How far the best of every run has got, generation by generation: Curves::json().
  std::string curves();

  /// The events of a run (Summary::id), or without one those of all runs' summaries alone.
  std::unique_ptr<Reader> read(const std::string& id);
  int readers() const;

  /// The summaries of now.
  std::vector<Summary> summaries() const;
  /// Whether the folder itself has vanished.
  bool is_gone() const;

  /// Tells readers, after all that is in the files by now, that this was all, and in which words. Nothing is
  /// looked at any more.
  void end(const std::string& text);

 private:
  struct Followed {
    SummaryReader reader;
    std::uint64_t version = 0;  ///< version_ of its latest change
  };
  void work();
  /// Whether something has changed.
  bool look(double now_s);
  bool find_runs();
  void add(const std::filesystem::path& folder, const std::string& id);
  bool look_at_study();
  /// The feed of a run, which all its readers share; null if there is no such run, or not yet.
  std::shared_ptr<Feed> feed_of(const std::string& id);
  const SummaryReader* find(const std::string& id) const;
  io::Json folder_json() const;

  const std::filesystem::path folder_;
  mutable std::mutex mutex_, elite_mutex_;
  std::mutex curves_mutex_;
  Curves curves_;
  std::condition_variable changed_;
  std::map<std::string, std::unique_ptr<Followed>> runs_;  ///< by Summary::id
  std::map<std::string, std::weak_ptr<Feed>> feeds_;
  std::optional<std::string> end_text_;
  bool single_ = false, gone_ = false, stopping_ = false;
  std::optional<int> planned_, recorded_;
  FileMark study_;
  std::uint64_t version_ = 1;  ///< grows with each change
  std::uint64_t folder_version_ = 1;
  int readers_ = 0;
  double find_due_s_ = 0.0, look_at_all_due_s_ = 0.0;
  LockHolders locks_;
  std::thread thread_;
};

/// Events for one page, in the form of server-sent events: "folder" (as Watcher::overview(), without runs),
/// "runs" ({"runs": [summaries that changed]}), "begin" ({"header": text}: the table begins, forget what
/// was), "rows" ({"lines": [text, …]}), "population" (PopulationReader::poll()), "end" ({"text": …}).
class Watcher::Reader {
 public:
  ~Reader();
  /// What is new, after at most `longest`; empty if nothing is, nothing after the end.
  std::optional<std::string> next(std::chrono::milliseconds longest);

 private:
  friend class Watcher;
  Reader(Watcher& watcher, std::string id);
  std::string events();
  void add_runs(std::string& events);
  void add_rows(std::string& events);
  bool is_behind() const;

  Watcher& watcher_;
  std::string id_;
  std::shared_ptr<Feed> feed_;  ///< null as long as there is no such run
  std::uint64_t seen_ = 0;
  int beginning_ = 0, populations_ = 0;
  std::size_t lines_ = 0;
  bool ended_ = false;
};

}  // namespace amble::watch
