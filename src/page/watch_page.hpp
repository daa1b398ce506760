#pragma once

#include <string>
#include <string_view>

namespace amble::page {

/// The page that watches runs (docs/WATCH.md), for any browser of 2023 or later. It asks the server that it
/// came from for "amble.wasm" (browser_module()), "events?run=ID" and "champion?run=ID&generation=N". The
/// module is not in the page, as packing it takes the time of some generations.
std::string make_watch_page(const std::string& made_by);

/// What may run in that page, as its Content-Security-Policy lists it: the hashes of its scripts, and
/// WebAssembly.
std::string_view watch_page_scripts();

}  // namespace amble::page
