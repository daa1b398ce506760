#pragma once

namespace amble::browser {

/// Whether kernels multiply and add with one rounding here, by products that show it: of WebAssembly's
/// relaxed instruction the browser says only that it may.
bool is_fused();

}  // namespace amble::browser
