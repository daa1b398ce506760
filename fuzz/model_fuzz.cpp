#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "amble/core/check.hpp"
#include "amble/morphology/model_text.hpp"
#include "fuzz/target.hpp"

namespace {

namespace fs = std::filesystem;

/// A folder of its own, because a model's includes are read from beside it.
fs::path model_path(const char* name) {
  static const fs::path folder = [] {
    fs::path made = fs::temp_directory_path() / ("amble_model_fuzz_" + std::to_string(::getpid()));
    fs::create_directories(made);
    return made;
  }();
  return folder / name;
}

}  // namespace

// The input is a model file: a URDF if it has an element <robot>, else MJCF. It ends before MuJoCo's
// compiler, which is not of this project.
AMBLE_FUZZ_TARGET(bytes) {
  const fs::path path = model_path(bytes.find("<robot") != std::string::npos ? "m.urdf" : "m.xml");
  std::ofstream(path, std::ios::binary) << bytes;
  amble::morphology::ReadingNotes notes;
  amble::morphology::ModelText text = amble::morphology::read_model_text(path, notes);
  // What is given to the compiler is XML, each element on its line.
  const amble::morphology::XmlText written = write_xml(text.root);
  amble::morphology::XmlElement again = amble::morphology::parse_xml(written.text, "again");
  const amble::morphology::XmlText rewritten = write_xml(again);
  AMBLE_CHECK(rewritten.text == written.text, written.text);
  for (std::size_t n = 0; n < written.lines.size(); ++n)
    AMBLE_CHECK(rewritten.lines[n]->line == static_cast<int>(n) + 1, written.text);
}
