#include "base/json_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/support/temporary_folder.h"

namespace tetraglass::base {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class JsonFile : public testing::Test {
 protected:
  JsonValue read(const std::string& text) {
    tests::write_text(file_, text);
    return JsonValue::read(file_);
  }
  template <class F>
  std::string error(const F& read_it) {
    try {
      read_it();
    } catch (const ReadError& e) {
      return e.what();
    }
    return "";
  }

  tests::TemporaryFolder folder_;
  std::string file_ = folder_.file("a.json");
};

TEST_F(JsonFile, ValuesByTheirPlaces) {
  const JsonValue root = read(R"({"a": [{"b": 1.5}, {"b": "x", "c": [1, 2]}]})");
  const std::vector<JsonValue> list = root.member("a").list("things");
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].member("b").number(), 1.5);
  EXPECT_EQ(list[1].member("b").text(), "x");
  EXPECT_EQ(list[1].member("c").numbers(2, "two numbers"), (std::vector<double>{1, 2}));
  EXPECT_FALSE(list[0].find("c").has_value());
}

TEST_F(JsonFile, ComplaintsNameFileAndPlace) {
  const JsonValue root = read(R"({"a": [{"b": 1.5}], "d": [1, null]})");
  const JsonValue first = root.member("a").list("things")[0];
  EXPECT_EQ(error([&] { static_cast<void>(first.member("c")); }), file_ + ": a[0] lacks 'c'");
  EXPECT_EQ(error([&] { static_cast<void>(first.member("b").text()); }),
            file_ + ": a[0].b must be a string, not number");
  EXPECT_EQ(error([&] { static_cast<void>(root.member("d").numbers(2, "two numbers")); }),
            file_ + ": d[1] must be a number, not null");
  EXPECT_EQ(error([&] { static_cast<void>(root.member("d").numbers(3, "three numbers")); }),
            file_ + ": d must be a list of three numbers");
  EXPECT_EQ(error([&] { static_cast<void>(root.list("things")); }),
            file_ + ": the file must be a list of things, not object");
  EXPECT_THAT(error([&] { first.allow_only({"bee"}); }),
              AllOf(HasSubstr("a[0] has an unknown key 'b'"), HasSubstr("bee")));
}

TEST_F(JsonFile, WhatIsNoJson) {
  EXPECT_THAT(error([&] { read("{\"a\":\n [}"); }),
              AllOf(HasSubstr(file_ + ": is not JSON"), HasSubstr("line 2, column 3")));
  EXPECT_EQ(error([&] { static_cast<void>(JsonValue::read(folder_.file("."))); }),
            folder_.file(".") + ": cannot be read");
}

}  // namespace
}  // namespace tetraglass::base
