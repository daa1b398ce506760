#include "amble/cppn/settings.hpp"

#include <gtest/gtest.h>

#include "amble/io/json_file.hpp"

namespace amble::cppn {
namespace {

TEST(CppnSettings, AreWrittenAndReadUnderTheirNames) {
  Settings settings{Linear::identity, false, Passes::twice_hidden_plus_1};
  io::Json json = io::Json::object();
  settings.describe(*io::json_writer(json));
  EXPECT_EQ(json.dump(), R"({"linear":"identity","recurrent":false,"passes":"2h+1"})");

  Settings read;
  read.describe(*io::json_reader(io::JsonView(json, "test")));
  EXPECT_EQ(read.linear, Linear::identity);
  EXPECT_FALSE(read.recurrent);
  EXPECT_EQ(read.passes, Passes::twice_hidden_plus_1);
}

TEST(CppnSettings, AreTheAuthorsByDefault) {
  EXPECT_EQ(Settings().linear, Linear::absolute);
  EXPECT_TRUE(Settings().recurrent);
  EXPECT_EQ(Settings().passes_with(6), 15);
}

}  // namespace
}  // namespace amble::cppn
