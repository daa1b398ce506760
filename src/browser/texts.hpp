#pragma once

#include <string>

namespace amble::browser {

/// What a page wrote for the function that it calls (amble_text), and what such a function gives
/// (amble_result).
const std::string& taken_text();
void give_text(std::string text);

}  // namespace amble::browser
