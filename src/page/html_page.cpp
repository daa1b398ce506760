#include "amble/page/html_page.hpp"

#include <fmt/format.h>
#include <cstddef>

#include "amble/core/index.hpp"
#include "amble/io/quoting.hpp"

namespace amble::page {

std::string html_page(std::string_view title, std::string_view style, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "img-src data:; base-uri 'none'; form-action 'none'\"/>\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n"
      "<body>\n<main>\n{}</main>\n</body>\n</html>\n",
      io::escape_xml(title), style, body);
}

}  // namespace amble::page

// The assembler includes the file unchanged.
asm(R"asm(
  .pushsection .rodata
  .global amble_view_page_begin
  .global amble_view_page_end
amble_view_page_begin:
  .incbin ")asm" AMBLE_VIEWER_PAGE R"asm("
amble_view_page_end:
  .byte 0
  .global amble_view_module_begin
  .global amble_view_module_end
amble_view_module_begin:
  .incbin ")asm" AMBLE_BROWSER_MODULE R"asm("
amble_view_module_end:
  .byte 0
  .global amble_relaxed_module_begin
  .global amble_relaxed_module_end
amble_relaxed_module_begin:
  .incbin ")asm" AMBLE_RELAXED_MODULE R"asm("
amble_relaxed_module_end:
  .byte 0
  .global amble_lab_page_begin
  .global amble_lab_page_end
amble_lab_page_begin:
  .incbin ")asm" AMBLE_LAB_PAGE R"asm("
amble_lab_page_end:
  .byte 0
  .global amble_watch_page_begin
  .global amble_watch_page_end
amble_watch_page_begin:
  .incbin ")asm" AMBLE_WATCH_PAGE R"asm("
amble_watch_page_end:
  .byte 0
  .popsection
)asm");

extern "C" {
extern const char amble_view_page_begin[];
extern const char amble_view_page_end[];
extern const char amble_view_module_begin[];
extern const char amble_view_module_end[];
extern const char amble_relaxed_module_begin[];
extern const char amble_relaxed_module_end[];
extern const char amble_lab_page_begin[];
extern const char amble_lab_page_end[];
extern const char amble_watch_page_begin[];
extern const char amble_watch_page_end[];
}

namespace amble::page {

std::string_view page_template() {
  return {amble_view_page_begin, to_index(amble_view_page_end - amble_view_page_begin)};
}

std::string_view lab_template() {
  return {amble_lab_page_begin, to_index(amble_lab_page_end - amble_lab_page_begin)};
}

std::string_view watch_template() {
  return {amble_watch_page_begin, to_index(amble_watch_page_end - amble_watch_page_begin)};
}

std::string_view browser_module() {
  return {amble_view_module_begin, to_index(amble_view_module_end - amble_view_module_begin)};
}

std::string_view relaxed_patch() {
  return {amble_relaxed_module_begin, to_index(amble_relaxed_module_end - amble_relaxed_module_begin)};
}

}  // namespace amble::page
