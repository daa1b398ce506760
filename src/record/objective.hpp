#pragma once

#include <string>
#include <string_view>

/// Results of trials.
namespace amble::record {

/// What evolution maximised, as pages, figures and reports name and measure it. By default the distance.
struct Objective {
  bool is_distance = true;  ///< score::Settings::is_distance
  std::string unit = " m";  ///< behind a number, with its space; " m" if all terms are lengths, else empty
  std::string title = "Distance walked";  ///< over a figure; "Score" if it is another

  /// The word for it in texts: "distance" or "score".
  std::string_view name() const { return is_distance ? "distance" : "score"; }
  friend bool operator==(const Objective&, const Objective&) = default;
};

}  // namespace amble::record
