#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/io/file.hpp"
#include "amble/page/replay_page.hpp"
#include "amble/presentation/shown_trial.hpp"
#include "amble/presentation/walker.hpp"

namespace amble::presentation {

/// What all walkers of a page have in common.
struct WalkersPageOptions {
  WalkOptions walk = {};
  TrialChoice disturbance = {};
  std::optional<std::string> title = {};
  bool history = false;  ///< the walkers are champions of one run, told apart by their generations

  /// What was asked for that a recording cannot have any more, e.g. "seconds"; empty: nothing.
  std::string_view not_for_recordings() const;
};

/// A page on which champions and recordings walk side by side, as it grows.
class WalkersPage {
 public:
  explicit WalkersPage(WalkersPageOptions options) : options_(std::move(options)) {}

  /// Lets a champion walk, its trials by `jobs` workers. `origin`: its file, or what it is called by.
  /// `run`: the folder by which it was asked for, as the best of its run. Nothing if `stop` was set; else
  /// what it typically does, in words, which is valid until the next is added. Throws UserError.
  const page::Walker* add_champion(const experiment::Champion& champion, const std::filesystem::path& origin,
                                   const std::optional<std::filesystem::path>& run, int jobs,
                                   const std::atomic<bool>& stop);

  /// As it was made, whatever the options say. `bytes`: what the file had. Throws UserError.
  void add_recording(const std::filesystem::path& file);
  void add_recording(std::string_view bytes, const std::filesystem::path& file);

  /// The page's text; the object is used up. Throws UserError as page::make_page() does.
  std::string html() &&;

 private:
  /// What a walker beside others is called by.
  struct Origin {
    std::string robot;
    std::filesystem::path run;
    std::string rest;  ///< generation and engine, where the input or the options name them
  };

  void give_titles();
  std::vector<std::string> names() const;

  WalkersPageOptions options_;
  std::deque<io::ScratchFile> scratch_;  ///< recordings of champions
  std::vector<Origin> origins_;          ///< of the page's walkers
  page::ReplayPage page_;
};

/// Up to eight champion files of a run, from the first to the last. Throws UserError.
std::vector<std::filesystem::path> champions_of_history(const std::filesystem::path& run);

}  // namespace amble::presentation
