#pragma once

#include "amble/core/version.hpp"

/// @file
/// What a shared library is that adds to the program `amble`.

/// A plugin is a shared library that adds controllers, searches, grounds, quantities and engines to the
/// program: `amble --plugin libmine.so evolve …` (docs/LIBRARY.md). It is one source with
///
///     AMBLE_PLUGIN { amble::controllers::register_controller({.name = "mine", …}); }
///
/// and is compiled against amble's installed headers, but linked with none of its libraries: it uses what the
/// program has. It must be built for the program's version by its compiler; else it is refused.
#define AMBLE_PLUGIN                                \
  extern "C" const char* amble_plugin_built_for() { \
    return AMBLE_PLUGIN_INTERFACE;                  \
  }                                                 \
  extern "C" void amble_plugin_register()

/// @cond
#define AMBLE_PLUGIN_TEXT_OF(text) #text
#define AMBLE_PLUGIN_TEXT(text) AMBLE_PLUGIN_TEXT_OF(text)
#if defined(__clang__)
#define AMBLE_PLUGIN_COMPILER "Clang " AMBLE_PLUGIN_TEXT(__clang_major__)
#else
#define AMBLE_PLUGIN_COMPILER "GCC " AMBLE_PLUGIN_TEXT(__GNUC__)
#endif
/// @endcond
/// What plugin and program must have in common, as a text, e.g. "amble 0.2.0, GCC 12".
#define AMBLE_PLUGIN_INTERFACE "amble " AMBLE_VERSION_TEXT ", " AMBLE_PLUGIN_COMPILER
