#include "amble/core/check.hpp"
#include "amble/io/binary.hpp"
#include "fuzz/target.hpp"

namespace {

enum class Colour : std::uint8_t { red, green };

/// Reads in the order that the payload itself gives: a byte per value.
void read_values(std::string_view payload) {
  amble::io::BinaryReader reader(payload, "x");
  while (true) {
    switch (reader.get<std::uint8_t>() % 7) {
      case 0:
        reader.get<double>();
        break;
      case 1:
        reader.get<bool>();
        break;
      case 2:
        reader.get_text();
        break;
      case 3:
        reader.get_vector<double>();
        break;
      case 4:
        reader.get_vector<std::uint8_t>();
        break;
      case 5:
        reader.get_enum<Colour>(2);
        break;
      default:
        reader.finish();
        return;
    }
  }
}

}  // namespace

AMBLE_FUZZ_TARGET(bytes) {
  using namespace amble;
  AMBLE_CHECK(io::unseal("AMBLETST", 1, io::seal("AMBLETST", 1, bytes), "x") == bytes,
              "opens to what was sealed");
  // The bytes once as a sealed file and once as a payload, because no mutation finds a checksum that fits.
  try {
    read_values(io::unseal("AMBLETST", 1, bytes, "x"));
  } catch (const UserError&) {
  }
  read_values(bytes);
}
