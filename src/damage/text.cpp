#include "amble/damage/text.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "amble/core/error.hpp"
#include "amble/io/text.hpp"

namespace amble::damage {
namespace {

/// One damage.
class PartParser {
 public:
  explicit PartParser(std::string_view text) : text_(text) {}

  Part parse() const {
    const std::size_t colon = text_.find(':');
    const auto kind = std::ranges::find(kind_names, text_.substr(0, colon));
    if (colon == std::string_view::npos || kind == kind_names.end())
      bad("KIND:NAME[=NUMBER][@SECONDS], KIND being one of {}", fmt::join(kind_names, ", "));
    Part part;
    part.kind = static_cast<Kind>(kind - kind_names.begin());
    // Names may have any character but those that end them here, so the last ones count.
    std::string_view rest = text_.substr(colon + 1);
    if (const std::size_t at = rest.rfind('@'); at != std::string_view::npos) {
      part.from_s = number(rest.substr(at + 1), 0.0, 1e9, "a moment of 0 s or later after '@'");
      rest = rest.substr(0, at);
    }
    const std::size_t equals = rest.rfind('=');
    const std::string name(rest.substr(0, equals));
    if (part.kind == Kind::missing || part.kind == Kind::numb)
      part.leg = name;
    else
      (part.kind == Kind::payload ? part.body : part.joint) = name;
    read_numbers(equals == std::string_view::npos ? "" : rest.substr(equals + 1), part);
    return part;
  }

 private:
  void read_numbers(std::string_view text, Part& part) const {
    if (part.kind == Kind::locked) {
      part.angle_rad = number(text, -1000.0, 1000.0, "an angle in rad after '='");
    } else if (part.kind == Kind::weak) {
      part.share = number(text, 0.0, 1.0, "a share from 0 to 1 after '='");
    } else if (part.kind == Kind::payload) {
      constexpr const char* what = "MASS_KG/X_M/Y_M/Z_M after '='";
      const auto numbers = io::split(text, '/');
      if (numbers.size() != 4) bad("{}", what);
      part.mass_kg = number(numbers[0], 1e-9, 1e6, what);
      part.x_m = number(numbers[1], -100.0, 100.0, what);
      part.y_m = number(numbers[2], -100.0, 100.0, what);
      part.z_m = number(numbers[3], -100.0, 100.0, what);
    } else if (!text.empty()) {
      bad("no number for this kind");
    }
  }

  double number(std::string_view digits, double lowest, double highest, std::string_view what) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() ||
        !(value >= lowest && value <= highest))
      bad("{}", what);
    return value;
  }

  template <typename... Args>
  [[noreturn]] void bad(fmt::format_string<Args...> expected, Args&&... args) const {
    fail(ExitCode::bad_input, "damage '{}': expected {}", io::printable(std::string(text_)),
         fmt::format(expected, std::forward<Args>(args)...));
  }

  std::string_view text_;
};

}  // namespace

Settings parse(std::string_view text) {
  Settings settings;
  for (const std::string_view part : io::split(text, ',')) settings.parts.push_back(PartParser(part).parse());
  return settings;
}

}  // namespace amble::damage
