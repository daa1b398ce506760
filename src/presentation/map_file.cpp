#include "amble/presentation/map_file.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "amble/core/error.hpp"
#include "amble/experiment/corrected_map.hpp"
#include "amble/io/file.hpp"
#include "amble/presentation/map_page.hpp"

namespace amble::presentation {
namespace {

constexpr int usual_trials = 20;

/// A kind of file with a whole map.
struct MapFile {
  std::string_view extension, beginning, what;
  bool has_new_trials;  ///< what each elite does in some, unless --retest 0
};
constexpr std::array map_files{
    MapFile{".html", "<!DOCTYPE html>", "a page", true}, MapFile{".svg", "<svg", "a picture", true},
    MapFile{".csv", "cell,", "a table", true},
    MapFile{".json", "{\n  \"format\": \"amble-repertoire\"", "a repertoire", false}};

/// Nothing if `stop` was set.
std::optional<std::string> text_of(const experiment::Repertoire& repertoire, const std::filesystem::path& run,
                                   const MapFile& file, const MapFileOptions& options,
                                   const std::atomic<bool>& stop) {
  if (!file.has_new_trials) return experiment::repertoire_json(repertoire);
  if (file.extension != ".csv") map_picture(repertoire);  // refuses before the trials
  const int trials = options.trials.value_or(repertoire.problem.trials_vary() ? usual_trials : 0);
  std::optional<experiment::CorrectedMap> corrected;
  if (trials > 0 && !(corrected = experiment::correct_map(repertoire, trials, options.jobs, stop)))
    return std::nullopt;
  if (file.extension == ".html") return map_page(repertoire, corrected, run, options.walkers, stop);
  return file.extension == ".csv" ? experiment::repertoire_csv(repertoire, corrected)
                                  : figures::map_svg(map_picture(repertoire, corrected));
}

}  // namespace

bool write_map_file(const experiment::Repertoire& repertoire, const std::filesystem::path& run,
                    const std::filesystem::path& out, const MapFileOptions& options,
                    const std::atomic<bool>& stop) {
  const auto file = std::ranges::find(map_files, out.extension().string(), &MapFile::extension);
  if (file == map_files.end())
    fail(ExitCode::bad_input, "--out {}: expected FILE.html, FILE.json, FILE.csv or FILE.svg", out.string());
  io::refuse_to_replace(out, std::string(file->beginning), std::string(file->what));
  const auto text = text_of(repertoire, run, *file, options, stop);
  if (text) io::write_file(out, *text);
  return text.has_value();
}

}  // namespace amble::presentation
