#include "amble/experiment/plan/table_digest.hpp"

#include <algorithm>

#include "amble/core/hash.hpp"
#include "amble/io/text.hpp"
#include "amble/record/generations_csv.hpp"

namespace amble::experiment {

std::uint64_t table_digest(std::uint64_t before, std::string_view header, std::string_view line) {
  const auto names = io::split(header.substr(0, header.find('\n')), ',');
  const auto untimed = std::ranges::find(names, record::column::wall_s) - names.begin();
  std::size_t end = 0;
  for (auto column = untimed; column > 0 && end < line.size(); --column)
    end = std::min(line.find(',', end), line.size() - 1) + 1;
  const std::uint64_t digest = hash_bytes(line.data(), end, before);
  return digest == 0 ? 1 : digest;
}

}  // namespace amble::experiment
