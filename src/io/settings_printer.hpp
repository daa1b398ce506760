#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::io {

/// Formats every field as TOML and passes it, with the text for its allowed values, to put().
class SettingsPrinter : public SettingsVisitor {
 public:
  using SettingsVisitor::integer;

  void number(std::string_view key, double& value, Range range, Doc doc) final;
  void integer(std::string_view key, std::int64_t& value, Range range, Doc doc) final;
  void flag(std::string_view key, bool& value, Doc doc) final;
  void text(std::string_view key, std::string& value, Doc doc) final;
  void texts(std::string_view key, std::vector<std::string>& values, Doc doc) final;
  void numbers(std::string_view key, std::vector<double>& values, Range range, Doc doc) final;
  void choice_index(std::string_view key, int& index, std::span<const std::string_view> names, Doc doc) final;

 private:
  virtual void put(std::string_view key, std::string value, std::string_view expected, Doc doc) = 0;
};

}  // namespace amble::io
