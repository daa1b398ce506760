#include "amble/serving/access.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

#include "amble/core/error.hpp"

namespace amble::serving {
namespace {

/// Without ":8080".
std::string_view without_port(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  if (colon == std::string_view::npos || host.ends_with(']')) return host;
  const auto digits = host.substr(colon + 1);
  const bool is_port = std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; });
  return is_port ? host.substr(0, colon) : host;
}

}  // namespace

bool names_loopback(std::string_view host) {
  std::string name(without_port(host));
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

std::string random_token() {
  std::array<unsigned char, 16> bits{};
  if (::getentropy(bits.data(), bits.size()) != 0) fail(ExitCode::io, "the system gives no random numbers");
  std::string token;
  for (const unsigned char byte : bits) token += fmt::format("{:02x}", byte);
  return token;
}

bool same_token(std::string_view expected, std::string_view given) {
  unsigned different = expected.size() == given.size() ? 0U : 1U;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const char other = given.empty() ? '\0' : given[i % given.size()];
    different |= static_cast<unsigned char>(expected[i]) ^ static_cast<unsigned char>(other);
  }
  return different == 0U;
}

std::string_view cookie(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const std::size_t end = std::min(header.find(';'), header.size());
    std::string_view part = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    while (part.starts_with(' ')) part.remove_prefix(1);
    if (part.starts_with(name) && part.substr(name.size()).starts_with('='))
      return part.substr(name.size() + 1);
  }
  return {};
}

}  // namespace amble::serving
