#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace amble::io {

/// Reads a file piece by piece. Throws UserError(ExitCode::io) "PATH: reason".
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  /// What a file had, from memory. `path`: its name, for messages.
  InputFile(std::string bytes, const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// The next `count` bytes, or fewer at the end of the file. Memory grows with what is read, not with
  /// `count`.
  std::string read(std::uint64_t count);

 private:
  std::filesystem::path path_;
  [[maybe_unused]] int fd_ = -1;  ///< −1: from memory
  std::string bytes_;             ///< then all of them
  std::size_t position_ = 0;
};

/// The whole file as bytes. Throws UserError(ExitCode::io) "PATH: reason", also if it is larger than
/// `limit_bytes`.
std::string read_file(const std::filesystem::path& path, std::uint64_t limit_bytes = std::uint64_t{1} << 32);

/// The file that this thread opened last to read it; empty: none. For messages about exceptions that do not
/// say what was being read.
std::string last_read_file();

/// Between a file's name and the number of process and machine in the name of its temporary file.
inline constexpr std::string_view temporary_mark = ".tmp.";

/// The temporary file of this process that becomes `path`.
std::filesystem::path temporary_of(const std::filesystem::path& path);
/// The file that a temporary file was to become, by its name ("a.json" of "a.json.tmp.12"); nothing for any
/// other file.
std::optional<std::filesystem::path> destination_of(const std::filesystem::path& temporary);

/// Replaces a file whole or not at all: what is written goes to PATH.tmp.<pid> in the same folder; commit()
/// syncs that, renames it and syncs the folder. Without commit(), or after a failure (no space, no
/// permission), the temporary file is removed and an old file is left as it was. A symbolic link is replaced,
/// not followed. What is there and is not a regular file (a pipe, /dev/stdout) is written to directly. Throws
/// UserError(ExitCode::io) "cannot write PATH: reason".
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  void commit();

 private:
  [[noreturn]] void give_up();

  std::filesystem::path path_;
  std::filesystem::path written_path_;  ///< the temporary file, or path_ itself
  int fd_ = -1;
};

/// One AtomicFile with these contents.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Syncs the directory entry of a new or renamed file or folder, so that it survives a power failure. Throws
/// UserError(ExitCode::io).
void sync_entry(const std::filesystem::path& path);

/// Makes a folder and those above it; nothing if it is there or the path is empty, as that of the folder of
/// "a.txt". Throws UserError(ExitCode::io).
void make_folder(const std::filesystem::path& folder);

/// Empty for a folder that can be read; else why it is none, for a message: "no such folder", "not a folder",
/// "Permission denied".
std::string why_no_folder(const std::filesystem::path& path);

/// Throws UserError(ExitCode::bad_input) if `path` is a file with contents that do not begin with
/// `beginning`, or, where others write such files, too, that do not look like amble's own: it is not of the
/// kind that would be written (`what`, e.g. "a recording"), and must not be replaced.
void refuse_to_replace(const std::filesystem::path& path, std::string_view beginning, std::string_view what);

/// Before an output is computed: refuse_to_replace(), and throws UserError(ExitCode::io) "cannot write PATH:
/// reason" where write_output() would. Changes nothing.
void check_output(const std::filesystem::path& path, std::string_view beginning, std::string_view what);

/// If the path leads to this process's standard output, as /dev/stdout does: from here on that output has it
/// alone, and what is printed goes to the standard error.
void keep_stdout_for(const std::filesystem::path& path);

/// make_folder() and write_file(): how a command writes to where its user says.
void write_output(const std::filesystem::path& path, std::string_view bytes);

/// A log that only grows (generations.csv): lines are appended whole and synced. On opening, what lies beyond
/// `keep_bytes` is cut off, so that a resumed run continues from its checkpoint. Throws
/// UserError(ExitCode::io), or ExitCode::bad_file if the file is missing or shorter.
class AppendFile {
 public:
  AppendFile(const std::filesystem::path& path, std::uint64_t keep_bytes);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void append(std::string_view bytes);
  /// The two halves of append(): what has been written survives the process, what has been synced a
  /// power failure. sync() may run in another thread than the next write().
  void write(std::string_view bytes);
  void sync();
  std::uint64_t size() const { return size_; }

 private:
  void cut_back_to(std::uint64_t keep_bytes);

  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

/// What to do with a sealed file of which only the checksum is wrong.
enum class Altered { refuse, accept };

/// A path for a file in a new private folder within the system's folder for temporary files; both are removed
/// by the destructor.
class ScratchFile {
 public:
  /// Throws UserError(ExitCode::io).
  explicit ScratchFile(const std::string& name);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace amble::io
