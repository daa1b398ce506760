#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <string>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"

namespace amble::test {

/// One to four random injuries: a flipped bit, a byte replaced, a piece cut out, inserted or doubled, the end
/// cut off.
inline std::string mutate(std::string bytes, Stream& stream) {
  const auto place = [&](std::size_t count) { return stream.below(static_cast<std::uint32_t>(count)); };
  for (std::uint32_t injuries = 1 + stream.below(4); injuries > 0 && !bytes.empty(); --injuries) {
    const std::size_t at = place(bytes.size());
    const std::size_t length = 1 + place(std::min<std::size_t>(bytes.size() - at, 16));
    switch (stream.below(6)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << stream.below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(stream.below(256));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, std::string(length, static_cast<char>(stream.below(256))));
        break;
      case 4:
        bytes.insert(place(bytes.size()), bytes.substr(at, length));
        break;
      default:
        bytes.resize(at);
        break;
    }
  }
  return bytes;
}

/// Reads `count` mutations of `bytes`; a reader may succeed or throw UserError, and nothing else. Returns how
/// many it refused.
template <typename Reader>
int refused_mutations(const std::string& bytes, int count, Reader&& read) {
  Stream stream(20130706, Purpose::test);
  int refused = 0;
  for (int i = 0; i < count; ++i) {
    const std::string mutant = mutate(bytes, stream);
    try {
      read(mutant);
    } catch (const UserError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos)
          << "more than one line: " << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "mutation " << i << ": " << error.what();
    }
  }
  return refused;
}

}  // namespace amble::test
