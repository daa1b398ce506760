#pragma once

#include <map>
#include <string>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::io {

/// A number that an extension (a controller, search, ground or engine of somebody's own) can be set by.
struct OwnNumber {
  std::string name;         ///< the key in its table
  double value = 0.0;       ///< the default
  Range range = {};         ///< what is allowed, in the unit that `what` names
  std::string what = {};    ///< one sentence, with the unit
  std::string source = {};  ///< where the number comes from
};

/// The numbers of an extension, in the table `own` of its part of a config (of an engine: `engine_own`).
/// Most of amble's own kinds have a struct each instead.
struct OwnSettings {
  std::map<std::string, double> numbers = {};  ///< by OwnNumber::name

  /// Visits the numbers of `known`, which are those of one kind of extension. What is not there is visited at
  /// its default, and is there from then on.
  void describe(SettingsVisitor& visitor, const std::vector<OwnNumber>& known) {
    for (const OwnNumber& own : known)
      visitor.number(own.name, numbers.try_emplace(own.name, own.value).first->second, own.range,
                     {own.what, own.source});
  }

  /// Adds those that are not there, at their defaults.
  void complete(const std::vector<OwnNumber>& known) {
    for (const OwnNumber& own : known) numbers.try_emplace(own.name, own.value);
  }
};

}  // namespace amble::io
