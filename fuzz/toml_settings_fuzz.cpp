#include "amble/core/check.hpp"
#include "amble/io/toml_settings.hpp"
#include "fuzz/target.hpp"
#include "tests/io/random_sample.hpp"

namespace {

amble::test::Sample read(const amble::io::TomlDocument& document) {
  amble::test::Sample sample;
  const auto reader = document.reader();
  sample.describe(*reader);
  reader->finish();
  return sample;
}

}  // namespace

// The input is a config; the part behind a NUL byte, if any, is an assignment of --set.
AMBLE_FUZZ_TARGET(bytes) {
  const std::size_t nul = bytes.find('\0');
  auto document = amble::io::TomlDocument::parse(std::string_view(bytes).substr(0, nul), "x.toml");
  if (nul != std::string::npos) document.set(std::string_view(bytes).substr(nul + 1));
  amble::test::Sample sample = read(document);

  // What was accepted can be written, and reads back to the same values.
  const std::string text =
      amble::io::settings_to_toml([&](amble::io::SettingsVisitor& visitor) { sample.describe(visitor); });
  const amble::test::Sample again = read(amble::io::TomlDocument::parse(text, "x.toml"));
  AMBLE_CHECK(amble::test::fingerprint(sample) == amble::test::fingerprint(again), text);
}
