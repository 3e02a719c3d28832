#include "tests/stability/record.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tetraglass::tests {

using project::Image;

Record::Record(std::string kind, std::string name, std::string origin)
    : kind_(std::move(kind)), name_(std::move(name)), origin_(std::move(origin)) {}

Record::~Record() {
  std::string line = kind_ + '\t' + name_;
  for (const std::string& way : kWays) {
    const auto found = worst_.find(way);
    if (found == worst_.end()) {
      line += "\t\t\t";
      continue;
    }
    const Worst& worst = found->second;
    fmt::print("{}: {}: {} {:.2g} of {:.2g}, {}\n", kind_, name_, way, worst.error, worst.bound,
               worst.detail);
    const auto told = told_.find(way);
    line += fmt::format("\t{:.2g}\t{:.2g}\t{}{}", worst.error, worst.bound, worst.detail,
                        told == told_.end() ? "" : "; " + told->second);
    testing::Test::RecordProperty(
        way, fmt::format("{}: {:.3g} of {:.3g}", name_, worst.error, worst.bound));
  }
  const char* table = std::getenv("TETRAGLASS_STABILITY_TABLE");
  if (table == nullptr) return;
  line += '\t' + origin_ + '\n';
  // One write at the end of the file: tests run side by side.
  if (std::FILE* file = std::fopen(table, "a")) {
    std::fwrite(line.data(), 1, line.size(), file);
    std::fclose(file);
  }
}

void Record::expect(const std::string& way, const std::string& detail, double error, double bound) {
  EXPECT_LE(error, bound) << name_ << ", " << way << ", " << detail;
  const auto [place, added] = worst_.try_emplace(way, Worst{error, bound, detail});
  Worst& worst = place->second;
  // Errors of 0 say the less the larger their bound.
  const double before = worst.bound > 0 ? worst.error / worst.bound : worst.error;
  const double now = bound > 0 ? error / bound : error;
  if (!added && (now > before || (now == before && bound < worst.bound))) {
    worst = {error, bound, detail};
  }
}

void Record::note_told(const std::string& way, const std::string& what) {
  told_[way] = what;
}

void Record::expect_near(const std::string& way, const std::string& detail, const Image& image,
                         const Image& exact, const Image& bound) {
  ASSERT_EQ(image.rgba.size(), exact.rgba.size()) << detail;
  float largest = 0;
  for (const float value : exact.rgba) largest = std::max(largest, std::abs(value));
  // Where rounding decides whether the ray meets the mesh, all is allowed and nothing told: such
  // pixels are looked at last.
  const auto is_open = [&](std::size_t i) { return bound.rgba[i] > 0.01F * largest; };
  double worst = -1;
  std::size_t at = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (!std::isfinite(image.rgba[i])) {
      worst = INFINITY;
      at = i;
      break;
    }
    const double error = std::abs(double{image.rgba[i]} - exact.rgba[i]);
    double part = error / bound.rgba[i];
    if (part <= 1 && is_open(i)) part *= 1e-9;
    if (part > worst) {
      worst = part;
      at = i;
    }
  }
  const std::size_t pixel = at / 4;
  const auto width = static_cast<std::size_t>(image.width);
  const double error = std::abs(double{image.rgba[at]} - exact.rgba[at]);
  expect(way,
         fmt::format("{} at ({}, {}) channel {}", detail, pixel % width, pixel / width, at % 4),
         std::isfinite(error) ? error : INFINITY, bound.rgba[at]);
}

void Record::expect_near(const std::string& way, const std::string& detail, const Image& image,
                         const Image& exact, double bound) {
  Image same = exact;
  std::fill(same.rgba.begin(), same.rgba.end(), static_cast<float>(bound));
  expect_near(way, detail, image, exact, same);
}

void expect_sound(const Image& image, const std::string& detail, double rounding) {
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    ASSERT_TRUE(std::isfinite(image.rgba[i])) << detail << ", value " << i;
    if (i % 4 != 3) continue;
    ASSERT_GE(image.rgba[i], -rounding) << detail << ", value " << i;
    ASSERT_LE(image.rgba[i], 1 + rounding) << detail << ", value " << i;
  }
}

}  // namespace tetraglass::tests
