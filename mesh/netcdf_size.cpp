#include "mesh/netcdf_size.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <vector>

namespace tetraglass::mesh {
namespace {

/// Takes the numbers of a head, big-endian; after the first that cannot be read all are 0.
class Head {
 public:
  explicit Head(const std::string& file) : in_(file, std::ios::binary) {}

  std::optional<std::uint64_t> file_size();

 private:
  std::uint64_t number(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const int byte = in_.get();
      if (!in_) return 0;
      value = (value << 8U) | static_cast<std::uint64_t>(byte);
    }
    return value;
  }
  /// A count, of 4 bytes but for CDF-5. A list ends with the file, however long it claims to be.
  std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }
  void skip(std::uint64_t bytes) {
    constexpr std::uint64_t kUnit = 4;  // everything is padded to it
    const std::uint64_t padded = (bytes + kUnit - 1) / kUnit * kUnit;
    if (padded < bytes || padded > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
      in_.setstate(std::ios::failbit);
      return;
    }
    in_.ignore(static_cast<std::streamsize>(padded));
  }
  std::uint64_t type_size() {
    switch (number(4)) {
      case 1:
      case 2:
      case 7:
        return 1;  // byte, char, ubyte
      case 3:
      case 8:
        return 2;
      case 4:
      case 5:
      case 9:
        return 4;
      case 6:
      case 10:
      case 11:
        return 8;
      default:
        in_.setstate(std::ios::failbit);
        return 0;
    }
  }
  void read_dimensions();
  void skip_attributes();
  void read_variables();

  struct Variable {
    std::uint64_t begin;
    std::uint64_t size;  ///< without the padding; of one record
    bool of_records;
  };

  std::ifstream in_;
  std::uint64_t version_ = 0;
  std::vector<std::uint64_t> dimensions_;
  std::vector<Variable> variables_;
};

void Head::read_dimensions() {
  number(4);  // the tag of the list, or 0 for an empty one
  const std::uint64_t n = count();
  for (std::uint64_t i = 0; i < n && in_; ++i) {
    skip(count());  // its name
    dimensions_.push_back(count());
  }
}

void Head::skip_attributes() {
  number(4);
  const std::uint64_t n = count();
  for (std::uint64_t i = 0; i < n && in_; ++i) {
    skip(count());
    const std::uint64_t size = type_size();
    skip(count() * size);
  }
}

void Head::read_variables() {
  number(4);
  const std::uint64_t n = count();
  for (std::uint64_t i = 0; i < n && in_; ++i) {
    skip(count());
    Variable variable{0, 1, false};
    const std::uint64_t rank = count();
    for (std::uint64_t k = 0; k < rank && in_; ++k) {
      const std::uint64_t dimension = count();
      if (dimension >= dimensions_.size()) {
        in_.setstate(std::ios::failbit);
        return;
      }
      if (k == 0 && dimensions_[dimension] == 0) {
        variable.of_records = true;
      } else {
        variable.size *= dimensions_[dimension];
      }
    }
    skip_attributes();
    variable.size *= type_size();
    count();  // its size with padding, which is wrong for the largest variables
    variable.begin = number(version_ == 1 ? 4 : 8);
    variables_.push_back(variable);
  }
}

std::optional<std::uint64_t> Head::file_size() {
  constexpr std::uint64_t kMagic = 0x434446;  // CDF
  if (number(3) != kMagic) return std::nullopt;
  version_ = number(1);
  if (version_ != 1 && version_ != 2 && version_ != 5) return std::nullopt;
  const std::uint64_t records = count();
  const std::uint64_t streaming = version_ == 5 ? ~std::uint64_t{0} : 0xffffffffU;
  read_dimensions();
  skip_attributes();
  read_variables();
  if (!in_) return std::nullopt;
  std::uint64_t record_size = 0;
  std::uint64_t record_variables = 0;
  for (const Variable& v : variables_) {
    if (!v.of_records) continue;
    record_size += (v.size + 3) / 4 * 4;
    ++record_variables;
  }
  std::uint64_t size = 0;
  for (const Variable& v : variables_) {
    if (!v.of_records) {
      size = std::max(size, v.begin + v.size);
    } else if (records > 0 && records != streaming) {
      // The records of a variable that has them alone are not padded.
      const std::uint64_t step = record_variables == 1 ? v.size : record_size;
      size = std::max(size, v.begin + (records - 1) * step + v.size);
    }
  }
  return size;
}

}  // namespace

std::optional<std::uint64_t> netcdf_size(const std::string& file) {
  return Head(file).file_size();
}

}  // namespace tetraglass::mesh
