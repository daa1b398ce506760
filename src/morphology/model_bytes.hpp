#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "amble/morphology/reading_notes.hpp"

namespace amble::morphology {

/// The largest model file that is read.
inline constexpr std::uint64_t largest_file_bytes = 50'000'000;

/// A character in UTF-8; one that is none becomes U+FFFD.
void append_utf8(std::string& text, char32_t character);

/// A file's bytes as UTF-8 without a byte order mark, whether they are UTF-8, UTF-16 or UTF-32 (with a byte
/// order mark or told by the zeros beside "<") or, if they are no UTF-8, Latin-1.
std::string as_utf8(std::string bytes);

/// The text of an XML file as UTF-8, cut behind its last ">": what editors leave there (zeros, Ctrl-Z) is no
/// part of it, and text is noted. Throws UserError: the file cannot be read, is larger than
/// `largest_file_bytes`, or is something that people take for a model: a web page, a pointer of Git LFS, or a
/// compressed file, with the command that unpacks it.
std::string read_xml_file(const std::filesystem::path& path, ReadingNotes& notes);

/// Where a command that is printed may write: to that path, or with a number in its name where that is there.
std::filesystem::path free_path(const std::filesystem::path& wished);

/// Whether it begins as the text that Git LFS leaves in place of a file that was not fetched.
bool is_lfs_pointer(std::string_view bytes);
/// What to do about it, for messages.
inline constexpr const char* lfs_remark = "a pointer of Git LFS in place of the file: run git lfs pull";

}  // namespace amble::morphology
