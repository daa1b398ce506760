#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "amble/core/hash.hpp"
#include "amble/io/file.hpp"

namespace amble::tests {

/// Texts (pictures, pages, tables) by file name, whose every byte is pinned: tests of single properties do
/// not see all that a reader sees. Where a hash differs, the text is written to a file to be looked at: if it
/// is as it should be, its hash is the new one.
inline void expect_golden(const std::map<std::string, std::string>& texts,
                          const std::map<std::string, std::string>& hashes) {
  for (const auto& [name, text] : texts) {
    const std::string hash = hex(hash_text(text));
    const auto expected = hashes.find(name);
    if (expected != hashes.end() && expected->second == hash) continue;
    const std::string file = testing::TempDir() + "amble-golden-" + name;
    io::write_file(file, text);
    ADD_FAILURE() << "{\"" << name << "\", \"" << hash << "\"},  // look at " << file;
  }
  EXPECT_EQ(texts.size(), hashes.size());
}

}  // namespace amble::tests
