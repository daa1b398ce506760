#pragma once

#include "amble/io/settings.hpp"

namespace amble::search {

/// CMA-ES on the weights of a CPPN that never grows.
struct CmaEsSettings {
  double step = 0.3;
  double least_step = 1e-6;

  void describe(io::SettingsVisitor& visitor);
  bool operator==(const CmaEsSettings&) const = default;
};

}  // namespace amble::search
