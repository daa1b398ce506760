#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/analysis/generations_csv.hpp"
#include "amble/analysis/recorded.hpp"

namespace amble::analysis {

/// A row of the table at the end of a page.
struct Fact {
  std::string label, value;
};

struct CppnSize {
  int hidden = 0, links = 0;
};

/// What a page is about besides what is in the recording. All texts are plain; the page escapes them.
struct PageInput {
  std::string title;
  std::string subtitle;
  std::optional<Generations>
      generations;                    ///< read_generations(); without it the page says nothing of evolution
  std::filesystem::path recording;    ///< of the champion
  std::optional<CppnSize> cppn;       ///< of the champion
  std::vector<Fact> facts;            ///< settings and provenance
  std::vector<std::string> commands;  ///< lines for a shell that make the page again
};

/// One self-contained HTML page, which is well-formed XML too: no network, no scripts. Throws UserError if
/// the recording cannot be read.
std::string make_page(const PageInput& input);

/// The same for a recording that is in memory; `input.recording` is not read.
std::string make_page(const PageInput& input, const Recorded& recorded);

}  // namespace amble::analysis
