// What C++ needs of a system and WebAssembly has not: exceptions end the module, with their message.
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <string>
#include <typeinfo>

#include "amble/core/check.hpp"

extern "C" {

/// The page's; it does not return.
[[noreturn, clang::import_module("amble"), clang::import_name("fail")]] void amble_fail(const char* text,
                                                                                        std::size_t size);

void* __cxa_allocate_exception(std::size_t size) noexcept {
  return std::malloc(size);
}
void __cxa_free_exception(void*) noexcept {}

/// All that amble and its libraries throw is a std::exception, first of its bases.
[[noreturn]] void __cxa_throw(void* thrown, std::type_info*, void (*)(void*)) {
  const std::string text = static_cast<std::exception*>(thrown)->what();
  amble_fail(text.data(), text.size());
}

/// Nothing outlives the only thread.
int __cxa_thread_atexit(void (*)(void*), void*, void*) noexcept {
  return 0;
}
}

namespace {

const auto previous_handler = amble::set_check_handler([](const amble::CheckFailure& failure) {
  const std::string text =
      std::string("check failed: ") + failure.condition + " (" + std::string(failure.detail) + ")";
  amble_fail(text.data(), text.size());
});

}  // namespace
