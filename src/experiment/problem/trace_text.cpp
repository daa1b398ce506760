#include "amble/experiment/problem/trace_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <system_error>

namespace amble::experiment {
namespace {

constexpr std::size_t digits_per_step = 8;

}  // namespace

std::string trace_text(const std::vector<std::uint32_t>& trace) {
  std::string text;
  for (const auto hash : trace) text += fmt::format("{:08x}", hash);
  return text;
}

std::vector<std::uint32_t> parse_trace(const io::JsonView& view) {
  const std::string text = view.text();
  if (text.size() % digits_per_step != 0) view.bad("eight hexadecimal digits per step");
  std::vector<std::uint32_t> trace(text.size() / digits_per_step);
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const char* const first = text.data() + i * digits_per_step;
    const auto [end, error] = std::from_chars(first, first + digits_per_step, trace[i], 16);
    if (error != std::errc() || end != first + digits_per_step) view.bad("eight hexadecimal digits per step");
  }
  return trace;
}

}  // namespace amble::experiment
