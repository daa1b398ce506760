#include "amble/io/file_kind.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "amble/io/file.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::io {
namespace {

class FileKinds : public testing::Test {
 protected:
  FileKind of(const std::string& text) {
    write_file(path_, text);
    return file_kind(path_);
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "file";
};

TEST_F(FileKinds, AreToldByTheContents) {
  EXPECT_EQ(of("{\n  \"format\": \"amble-champion\",\n"), FileKind::champion);
  EXPECT_EQ(of("\n{\"format\":\"amble-robot\",\"version\":1}"), FileKind::robot);
  EXPECT_EQ(of("{\"format\": \"another\"}"), FileKind::other);
  EXPECT_EQ(of("{\"format\""), FileKind::other);
  EXPECT_EQ(of("AMBLEREC\1\0"), FileKind::recording);
  EXPECT_EQ(of("<!-- " + std::string(9000, 'x') + " -->\n<mujoco model=\"a\">"), FileKind::model);
  EXPECT_EQ(of("<?xml version=\"1.0\"?>\n<robot name=\"a\">"), FileKind::model);
  EXPECT_EQ(of("<!DOCTYPE html>"), FileKind::other);
  EXPECT_EQ(of("robot = \"a.toml\"\n"), FileKind::config);
  EXPECT_EQ(of("[controller]\nkind = \"sine\"\n"), FileKind::config);
  EXPECT_EQ(of("model = \"a.xml\"\nlegs = [\"L\"]\n"), FileKind::side_file);
  EXPECT_EQ(of("generations = 3\n[[conditions]]\nname = \"a\"\n"), FileKind::study);
  EXPECT_EQ(of("colour = 3\n"), FileKind::other);
  EXPECT_EQ(of("robot = \n"), FileKind::other) << "TOML with an error, which its reader names";
  EXPECT_EQ(of(""), FileKind::other);
}

TEST_F(FileKinds, IncludedFilesCount) {
  write_file(folder_ / "base.toml", "robot = \"a.toml\"\n");
  EXPECT_EQ(of("include = [\"base.toml\"]\nname = \"mine\"\n"), FileKind::config);
  EXPECT_EQ(of("include = [\"lost.toml\"]\n"), FileKind::other);
}

TEST_F(FileKinds, WhatIsNoFileIsNotRead) {
  EXPECT_EQ(file_kind(folder_ / "none"), FileKind::none);
  EXPECT_EQ(file_kind(""), FileKind::none);
  EXPECT_EQ(file_kind(folder_.path()), FileKind::folder);
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(file_kind(path_), FileKind::other) << "a pipe that nobody writes would be waited for";
}

}  // namespace
}  // namespace amble::io
