#include "amble/core/check.hpp"
#include "amble/io/json_file.hpp"
#include "fuzz/target.hpp"
#include "tests/io/random_sample.hpp"

// The checksum is not verified: it would keep the fuzzer from the code behind it.
AMBLE_FUZZ_TARGET(bytes) {
  using namespace amble;
  const io::Json document = io::unseal_json("sample", 1, bytes, "x.json", io::Altered::accept).document;
  const auto sample = io::settings_from_json<test::Sample>(io::JsonView(document, "x.json"));

  // What was accepted can be sealed, and opens again with the same values.
  const std::string sealed = io::sealed_json("sample", 1, io::settings_to_json(sample));
  const io::Json opened = io::unseal_json("sample", 1, sealed, "x.json").document;
  const auto again = io::settings_from_json<test::Sample>(io::JsonView(opened, "x.json"));
  AMBLE_CHECK(test::fingerprint(sample) == test::fingerprint(again), sealed);
}
