#include "amble/morphology/model_bytes.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"

namespace amble::morphology {
namespace {

constexpr char32_t unknown_character = 0xFFFD;

std::string from_utf16(std::string_view bytes, bool low_first) {
  const auto unit = [&](std::size_t at) {
    const auto a = static_cast<unsigned char>(bytes[at]), b = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<char32_t>(low_first ? a | b << 8 : b | a << 8);
  };
  std::string text;
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    char32_t character = unit(at);
    const bool first_half = character >= 0xD800 && character < 0xDC00;
    if (first_half && at + 3 < bytes.size()) {
      const char32_t second = unit(at + 2);
      if (second >= 0xDC00 && second < 0xE000) {
        character = 0x10000 + ((character - 0xD800) << 10) + (second - 0xDC00);
        at += 2;
      }
    }
    append_utf8(text, character);
  }
  return text;
}

std::string from_utf32(std::string_view bytes, bool low_first) {
  std::string text;
  for (std::size_t at = 0; at + 3 < bytes.size(); at += 4) {
    std::uint32_t character = 0;
    for (std::size_t i = 0; i < 4; ++i)
      character = character << 8 | static_cast<unsigned char>(bytes[low_first ? at + 3 - i : at + i]);
    append_utf8(text, character);
  }
  return text;
}

/// Length of the character in UTF-8 that begins there, or 0.
std::size_t utf8_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  const bool follows = std::ranges::all_of(
      text.substr(1, length - 1), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; });
  return follows ? length : 0;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

/// Whether the text begins so, after blanks, in capitals or not.
bool begins(std::string_view text, std::string_view with_what) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  return text.size() >= with_what.size() &&
         std::equal(with_what.begin(), with_what.end(), text.begin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

void refuse_what_is_no_model(std::string_view text, const std::filesystem::path& path) {
  if (begins(text, "<!doctype html") || begins(text, "<html"))
    fail(ExitCode::bad_input, "{}: a web page, not a model: fetch the file itself (\"raw\")", path.string());
  if (is_lfs_pointer(text)) fail(ExitCode::bad_input, "{}: {}", path.string(), lfs_remark);
}

/// Packed files are told by their first bytes, with what unpacks them.
void refuse_what_is_packed(std::string_view bytes, const std::filesystem::path& path) {
  using namespace std::string_view_literals;
  struct Packing {
    std::string_view first, ending, name, command;
  };
  static constexpr std::array packings{Packing{"\x1F\x8B"sv, ".gz", "gzip", "gunzip"},
                                       Packing{"BZh"sv, ".bz2", "bzip2", "bunzip2"},
                                       Packing{"\xFD"
                                               "7zXZ\0"sv,
                                               ".xz", "xz", "unxz"},
                                       Packing{"\x28\xB5\x2F\xFD"sv, ".zst", "zstd", "unzstd"},
                                       Packing{"PK\x03\x04"sv, ".zip", "zip", "unzip"}};
  const auto packing =
      std::ranges::find_if(packings, [&](const Packing& known) { return bytes.starts_with(known.first); });
  if (packing == packings.end()) return;
  const std::string file = io::shell_word(path.string());
  std::string command = fmt::format("{} {}", packing->command, file);
  // Without their ending these programs leave a file alone.
  if (path.extension() != packing->ending && packing->ending != ".zip") {
    const std::string name = path.stem().string() + "_unpacked" + path.extension().string();
    command = fmt::format("{} < {} > {}", packing->command, file,
                          io::shell_word(free_path(path.parent_path() / name).string()));
  }
  fail(ExitCode::bad_input, "{}: it is compressed ({}): unpack it first: {}", path.string(), packing->name,
       command);
}

}  // namespace

void append_utf8(std::string& text, char32_t character) {
  const auto add = [&](char32_t byte) { text += static_cast<char>(byte); };
  if (character > 0x10FFFF || (character >= 0xD800 && character < 0xE000)) character = unknown_character;
  if (character < 0x80) {
    add(character);
  } else if (character < 0x800) {
    add(0xC0 | character >> 6);
    add(0x80 | (character & 0x3F));
  } else if (character < 0x10000) {
    add(0xE0 | character >> 12);
    add(0x80 | (character >> 6 & 0x3F));
    add(0x80 | (character & 0x3F));
  } else {
    add(0xF0 | character >> 18);
    add(0x80 | (character >> 12 & 0x3F));
    add(0x80 | (character >> 6 & 0x3F));
    add(0x80 | (character & 0x3F));
  }
}

std::string as_utf8(std::string bytes) {
  using namespace std::string_view_literals;
  const std::string_view all = bytes;
  // Before UTF-16, whose mark of low bytes first its own begins with.
  if (all.starts_with("\xFF\xFE\0\0"sv)) return from_utf32(all.substr(4), true);
  if (all.starts_with("\0\0\xFE\xFF"sv)) return from_utf32(all.substr(4), false);
  if (all.starts_with("<\0\0\0"sv)) return from_utf32(all, true);
  if (all.starts_with("\0\0\0<"sv)) return from_utf32(all, false);
  if (all.starts_with("\xFF\xFE"sv)) return from_utf16(all.substr(2), true);
  if (all.starts_with("\xFE\xFF"sv)) return from_utf16(all.substr(2), false);
  if (all.starts_with("<\0"sv)) return from_utf16(all, true);
  if (all.starts_with("\0<"sv)) return from_utf16(all, false);
  if (all.starts_with("\xEF\xBB\xBF"sv)) bytes.erase(0, 3);
  if (is_utf8(bytes)) return bytes;
  std::string text;
  for (const char c : bytes) append_utf8(text, static_cast<unsigned char>(c));
  return text;
}

bool is_lfs_pointer(std::string_view bytes) {
  return bytes.starts_with("version https://git-lfs.github.com/spec/");
}

std::filesystem::path free_path(const std::filesystem::path& wished) {
  std::filesystem::path path = wished;
  std::error_code error;
  for (int k = 2; std::filesystem::exists(path, error); ++k)
    path.replace_filename(fmt::format("{}_{}{}", wished.stem().string(), k, wished.extension().string()));
  return path;
}

std::string read_xml_file(const std::filesystem::path& path, ReadingNotes& notes) {
  std::string bytes = io::read_file(path, largest_file_bytes);
  refuse_what_is_packed(bytes, path);
  std::string text = as_utf8(std::move(bytes));
  refuse_what_is_no_model(text, path);
  const std::size_t end = text.rfind('>');
  if (end == std::string::npos) return text;
  const bool more = std::ranges::any_of(std::string_view(text).substr(end + 1),
                                        [](unsigned char c) { return c > ' ' && c != 0x7F; });
  const bool zeros = text.find_first_of(std::string_view("\0\x1A", 2), end) != std::string::npos;
  if (!more && !zeros) return text;
  if (more)
    notes.add(Reading::left_out, fmt::format("text behind the last element of {}", path.filename().string()));
  text.erase(end + 1);
  return text;
}

}  // namespace amble::morphology
