#include "amble/core/check.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace amble {
namespace {

void print(const CheckFailure& failure) {
  std::fprintf(stderr, "%s:%d: check failed: %s (%.*s)\n", failure.file, failure.line, failure.condition,
               static_cast<int>(failure.detail.size()), failure.detail.data());
}

std::atomic<CheckHandler> handler_now{print};

}  // namespace

CheckHandler set_check_handler(CheckHandler handler) {
  return handler_now.exchange(handler != nullptr ? handler : print);
}

void check_failed(const char* file, int line, const char* condition, std::string_view detail) {
  handler_now.load()({file, line, condition, detail});
  std::abort();
}

}  // namespace amble
