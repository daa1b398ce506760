#pragma once

#include "amble/ground/height_field.hpp"
#include "amble/io/json_file.hpp"

namespace amble::ground {

/// Names a field in files: {"settings": …, "key": …}.
io::Json to_json(const Settings& settings, const Key& key);

/// The field named so, made again. Throws UserError.
HeightField field_from_json(const io::JsonView& json);

}  // namespace amble::ground
