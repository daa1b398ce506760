#pragma once

/// @file
/// Which version of amble this is.

/// @{
/// The version of the headers, by which a program can choose: `#if AMBLE_VERSION >= 200` is 0.2.0 or later.
/// What versions promise: docs/LIBRARY.md.
#define AMBLE_VERSION_MAJOR 0
#define AMBLE_VERSION_MINOR 2
#define AMBLE_VERSION_PATCH 0
#define AMBLE_VERSION (AMBLE_VERSION_MAJOR * 10000 + AMBLE_VERSION_MINOR * 100 + AMBLE_VERSION_PATCH)
/// @}

/// @cond
#define AMBLE_VERSION_TEXT_OF(major, minor, patch) #major "." #minor "." #patch
#define AMBLE_VERSION_TEXT_BY(major, minor, patch) AMBLE_VERSION_TEXT_OF(major, minor, patch)
/// @endcond
/// As a text: "0.2.0".
#define AMBLE_VERSION_TEXT \
  AMBLE_VERSION_TEXT_BY(AMBLE_VERSION_MAJOR, AMBLE_VERSION_MINOR, AMBLE_VERSION_PATCH)
