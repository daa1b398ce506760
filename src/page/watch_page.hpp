#pragma once

#include <string>

namespace amble::page {

/// The page that watches runs (docs/WATCH.md): with the simulator in it, for any browser of 2023 or later. It
/// asks the server that it came from for "events?run=ID" and "champion?run=ID&generation=N".
std::string make_watch_page(const std::string& made_by);

}  // namespace amble::page
