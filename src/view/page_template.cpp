#include "amble/view/page_template.hpp"

#include <cstddef>

// The assembler puts the file into the program as it is.
asm(R"asm(
  .pushsection .rodata
  .global amble_view_page_begin
  .global amble_view_page_end
amble_view_page_begin:
  .incbin ")asm" AMBLE_VIEWER_PAGE R"asm("
amble_view_page_end:
  .byte 0
  .popsection
)asm");

extern "C" {
extern const char amble_view_page_begin[];
extern const char amble_view_page_end[];
}

namespace amble::view {

std::string_view page_template() {
  return {amble_view_page_begin, static_cast<std::size_t>(amble_view_page_end - amble_view_page_begin)};
}

}  // namespace amble::view
