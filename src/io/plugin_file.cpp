#include "amble/io/plugin_file.hpp"

#include <dlfcn.h>

#include <string>
#include <string_view>
#include <system_error>

#include "amble/core/error.hpp"
#include "amble/core/plugin.hpp"

namespace amble::io {

void load_plugin(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) fail(ExitCode::io, "plugin {}: no such file", file.string());
  // With a slash in its name it is not looked for elsewhere.
  const std::string path = std::filesystem::absolute(file).string();
  void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) fail(ExitCode::bad_input, "plugin {}: {}", file.string(), ::dlerror());
  const auto built_for = reinterpret_cast<const char* (*)()>(::dlsym(library, "amble_plugin_built_for"));
  const auto register_all = reinterpret_cast<void (*)()>(::dlsym(library, "amble_plugin_register"));
  if (built_for == nullptr || register_all == nullptr)
    fail(ExitCode::bad_input, "plugin {}: no plugin of amble: it has no AMBLE_PLUGIN (amble/core/plugin.hpp)",
         file.string());
  const std::string_view wanted = built_for();
  if (wanted != AMBLE_PLUGIN_INTERFACE)
    fail(ExitCode::bad_input, "plugin {}: built for {}, but this is {}: build it anew", file.string(), wanted,
         AMBLE_PLUGIN_INTERFACE);
  try {
    register_all();
  } catch (const UserError& reason) {
    fail(reason.code(), "plugin {}: {}", file.string(), reason.what());
  }
}

}  // namespace amble::io
