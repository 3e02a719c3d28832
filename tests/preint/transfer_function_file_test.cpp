#include "preint/transfer_function_file.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "preint/transfer_function.h"

namespace tetraglass::preint {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class TransferFunctionFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  TransferFunction read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_transfer_function(file_);
  }

  std::string error(const std::string& text) const {
    try {
      read(text);
    } catch (const base::ReadError& e) {
      return e.what();
    }
    return "no ReadError";
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                  testing::UnitTest::GetInstance()->current_test_info()->name();
  std::string file_ = (folder_ / "tf.json").string();
};

TEST_F(TransferFunctionFile, WhatIsWrittenReadsBackToTheLastBit) {
  const TransferFunction tf({{-1.0 / 3, {0.1, 2.0 / 3, 1e-17}, 1e300},
                             {0, {0, 0.5, 1}, 0, {0.25, 0.1 + 0.2, 0, 1e3}},
                             {0, {1, 1, 1}, 0.7, {}}});
  write_transfer_function(tf, file_);
  const TransferFunction again = read_transfer_function(file_);
  ASSERT_EQ(again.points().size(), tf.points().size());
  for (std::size_t i = 0; i < tf.points().size(); ++i) {
    const ControlPoint& a = tf.points()[i];
    const ControlPoint& b = again.points()[i];
    EXPECT_EQ(a.value, b.value);
    EXPECT_TRUE((a.color == b.color).all());
    EXPECT_EQ(a.extinction, b.extinction);
    EXPECT_EQ(a.material.ambient, b.material.ambient);
    EXPECT_EQ(a.material.diffuse, b.material.diffuse);
    EXPECT_EQ(a.material.specular, b.material.specular);
    EXPECT_EQ(a.material.shininess, b.material.shininess);
  }
}

TEST_F(TransferFunctionFile, ReadsPoints) {
  const TransferFunction tf = read(
      R"({"points": [{"value": 0.0, "color": [0.1, 0.2, 0.9], "extinction": 0},
                     {"value": 1, "color": [1.0, 0.6, 0.1], "extinction": 4.0}]})");
  ASSERT_EQ(tf.points().size(), 2U);
  EXPECT_TRUE((tf.points()[0].color == Color(0.1, 0.2, 0.9)).all());
  EXPECT_EQ(tf.points()[1].extinction, 4);
  EXPECT_EQ(tf.at(0.5).extinction, 2);
}

TEST_F(TransferFunctionFile, ReadsMaterials) {
  const TransferFunction tf = read(
      R"({"points": [{"value": 0, "color": [1, 1, 1], "extinction": 1,
                      "ambient": 0.3, "diffuse": 0.5, "specular": 0.6, "shininess": 10},
                     {"value": 1, "color": [1, 1, 1], "extinction": 1}]})");
  const Material m = tf.material_at(0.5);  // half way to the defaults 0.1, 0.7, 0.2, 32
  EXPECT_DOUBLE_EQ(m.ambient, 0.2);
  EXPECT_DOUBLE_EQ(m.diffuse, 0.6);
  EXPECT_DOUBLE_EQ(m.specular, 0.4);
  EXPECT_DOUBLE_EQ(m.shininess, 21);
  EXPECT_EQ(tf.material_at(-1).shininess, 10);
  EXPECT_EQ(tf.material_at(1).shininess, 32);
  EXPECT_TRUE((materials_as_colors(tf).at(0).color == Color(0.3, 0.5, 0.6)).all());

  const std::string point = R"({"points": [{"value": 0, "color": [1, 1, 1], "extinction": 1, )";
  EXPECT_THAT(error(point + R"("diffuse": "x"}]})"),
              HasSubstr("points[0].diffuse must be a number, not string"));
  EXPECT_THAT(error(point + R"("ambient": -1}]})"), HasSubstr("points[0]: ambient, diffuse"));
}

TEST_F(TransferFunctionFile, ErrorsSayWhere) {
  EXPECT_THAT(error("{\"points\":\n [}"),
              AllOf(HasSubstr(file_ + ": is not JSON"), HasSubstr("line 2, column 3")));
  EXPECT_THAT(error(""), HasSubstr("is not JSON"));
  EXPECT_THAT(error("[]"), HasSubstr("the file must be an object, not array"));
  EXPECT_THAT(error("{}"), HasSubstr("lacks 'points'"));
  EXPECT_THAT(error(R"({"pionts": []})"),
              AllOf(HasSubstr("unknown key 'pionts'"), HasSubstr("did you mean 'points'?")));
  EXPECT_THAT(error(R"({"points": 3})"), HasSubstr("points must be a list of points, not number"));
  EXPECT_THAT(error(R"({"points": []})"), HasSubstr(file_ + ": a transfer function needs"));
  EXPECT_THAT(error(R"({"points": [7]})"), HasSubstr("points[0] must be an object"));
  EXPECT_THAT(error(R"({"points": [{"value": 0, "extinction": 1}]})"),
              HasSubstr("points[0] lacks 'color'"));
  EXPECT_THAT(error(R"({"points": [{"value": 0, "colour": [1,1,1], "extinction": 1}]})"),
              AllOf(HasSubstr("unknown key 'colour'"), HasSubstr("'color'")));
  EXPECT_THAT(error(R"({"points": [{"value": 0, "color": [1,1], "extinction": 1}]})"),
              HasSubstr("points[0].color must be a list of three numbers"));
  EXPECT_THAT(error(R"({"points": [{"value": 0, "color": [1,null,1], "extinction": 1}]})"),
              HasSubstr("points[0].color[1] must be a number, not null"));
  EXPECT_THAT(error(R"({"points": [{"value": 0, "color": [1,1,1], "extinction": -1}]})"),
              HasSubstr("points[0]: extinction must not be negative"));
  EXPECT_THAT(error(R"({"points": [{"value": 1e999, "color": [1,1,1], "extinction": 1}]})"),
              HasSubstr(file_));
}

TEST_F(TransferFunctionFile, MissingFilesAndFolders) {
  for (const std::string& path : {file_, folder_.string()}) {
    try {
      static_cast<void>(read_transfer_function(path));
      FAIL() << path << " was read";
    } catch (const base::ReadError& e) {
      EXPECT_EQ(std::string(e.what()), path + ": cannot be read");
    }
  }
}

}  // namespace
}  // namespace tetraglass::preint
