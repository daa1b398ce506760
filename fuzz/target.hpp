#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "amble/core/error.hpp"

/// The body of a fuzzer: `AMBLE_FUZZ_TARGET(bytes) { read(bytes); }` with `const std::string& bytes`. A
/// UserError is the expected response to a damaged file; any other exception, a failed check or a sanitizer's
/// report is a finding.
#define AMBLE_FUZZ_TARGET(bytes)                                                     \
  static void fuzz_target(const std::string& bytes);                                 \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size); \
  int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {           \
    try {                                                                            \
      fuzz_target(std::string(reinterpret_cast<const char*>(data), size));           \
    } catch (const amble::UserError&) {                                              \
    }                                                                                \
    return 0;                                                                        \
  }                                                                                  \
  static void fuzz_target(const std::string& bytes)
