#pragma once

#include <array>
#include <map>
#include <string>

#include "project/image.h"

namespace tetraglass::tests {

/// The columns of the table: the projectors as they are by default; and gl by tables, psi and the
/// ends of segments alone.
inline const std::array<std::string, 4> kWays = {"cpu", "gl", "gl tables", "reference"};

/// What one hard case came to: of each way to draw the pair of error and bound that comes nearest
/// to failing. Printed at its end, kept as a property of the test, and written as a line of the
/// table $TETRAGLASS_STABILITY_TABLE where that names a file (scripts/stability-table).
class Record {
 public:
  /// `kind` and `name`: the rows of the table; `origin`: where the bound comes from.
  Record(std::string kind, std::string name, std::string origin);
  ~Record();
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

  /// Expects error <= bound. `way`: one of kWays; `detail`: mode, view, pixel.
  void expect(const std::string& way, const std::string& detail, double error, double bound);

  /// Notes that this way does not draw the case and says so.
  void note_told(const std::string& way, const std::string& what);

  /// Expects each channel of every pixel to be finite and as near to `exact` as `bound` says.
  void expect_near(const std::string& way, const std::string& detail, const project::Image& image,
                   const project::Image& exact, const project::Image& bound);

  /// The same with one bound for all.
  void expect_near(const std::string& way, const std::string& detail, const project::Image& image,
                   const project::Image& exact, double bound);

 private:
  struct Worst {
    double error = 0;
    double bound = 0;
    std::string detail;
  };

  std::string kind_;
  std::string name_;
  std::string origin_;
  std::map<std::string, Worst> worst_;
  std::map<std::string, std::string> told_;
};

/// Expects every channel to be finite, and opacities to lie between 0 and 1 (but for
/// `rounding`).
void expect_sound(const project::Image& image, const std::string& detail, double rounding = 1e-5);

}  // namespace tetraglass::tests
