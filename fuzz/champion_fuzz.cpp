#include "amble/core/check.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/io/json_file.hpp"
#include "fuzz/target.hpp"

// The checksum is not verified: it would keep the fuzzer from the code behind it.
AMBLE_FUZZ_TARGET(bytes) {
  using namespace amble::experiment;
  const Champion champion = parse_champion(bytes, "c.json", amble::io::Altered::accept).champion;

  // What was accepted can become a controller, and be written and read again.
  champion.problem.decode(champion.genome);
  const Champion again = parse_champion(champion_text(champion), "c.json").champion;
  AMBLE_CHECK(again.genome == champion.genome, "a champion reads back");
}
