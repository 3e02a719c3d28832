#include "mesh/read_pos.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"
#include "mesh/time_step.h"

namespace tetraglass::mesh {
namespace {

/// A kind of element by the second letter of its name.
struct Element {
  char letter;
  CellType type;
  std::vector<std::size_t> order;  ///< the corner that each of the cell's points is
};

const std::vector<Element>& elements() {
  static const std::vector<Element> kTable = {
      {'P', CellType::vertex, {0}},
      {'L', CellType::line, {0, 1}},
      {'T', CellType::triangle, {0, 1, 2}},
      {'Q', CellType::quad, {0, 1, 2, 3}},
      {'S', CellType::tetra, {0, 1, 2, 3}},
      {'H', CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}},
      {'I', CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {'Y', CellType::pyramid, {0, 1, 2, 3, 4}},
  };
  return kTable;
}

/// Values at a corner by the first letter of an element's name; 0 if it is none.
std::size_t components(char letter) {
  return letter == 'S' ? 1 : letter == 'V' ? 3 : letter == 'T' ? 9 : 0;
}

class PosReader {
 public:
  explicit PosReader(const std::string& file) : file_(file), content_(content_of(file)) {}

  MeshData read(const std::string& time);

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void skip_spaces();
  std::string_view name();
  void expect(char c);
  std::vector<double> list(char open, char close);
  void read_element(std::string_view name);
  void choose_step(const std::string& time);
  std::uint32_t point(const Eigen::Vector3d& place, std::span<const double> values);

  std::string file_;
  std::string content_;
  std::size_t at_ = 0;
  MeshData mesh_;
  std::vector<std::vector<double>> coordinates_;  ///< of each element
  std::vector<std::vector<double>> values_;       ///< of each element: for each step, each corner
  std::vector<const Element*> kinds_;
  std::vector<double> times_;
  std::size_t components_ = 0;
  std::size_t left_out_ = 0;
  std::map<std::vector<double>, std::uint32_t> numbers_;  ///< by place and values
};

void PosReader::fail(const std::string& what) const {
  const auto end = content_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, content_.size()));
  throw base::ReadError(
      file_, fmt::format("line {}: {}", std::count(content_.begin(), end, '\n') + 1, what));
}

/// Spaces, and remarks to the end of a line or between /* and */.
void PosReader::skip_spaces() {
  while (at_ < content_.size()) {
    if (std::isspace(static_cast<unsigned char>(content_[at_])) != 0) {
      ++at_;
    } else if (content_.compare(at_, 2, "//") == 0) {
      at_ = std::min(content_.find('\n', at_), content_.size());
    } else if (content_.compare(at_, 2, "/*") == 0) {
      const std::size_t end = content_.find("*/", at_ + 2);
      at_ = end == std::string::npos ? content_.size() : end + 2;
    } else {
      return;
    }
  }
}

std::string_view PosReader::name() {
  skip_spaces();
  const std::size_t start = at_;
  while (at_ < content_.size() &&
         (std::isalnum(static_cast<unsigned char>(content_[at_])) != 0 || content_[at_] == '_')) {
    ++at_;
  }
  return std::string_view(content_).substr(start, at_ - start);
}

void PosReader::expect(char c) {
  skip_spaces();
  if (at_ >= content_.size() || content_[at_] != c) {
    fail(fmt::format("there should be a '{}' here; only lists of numbers are read", c));
  }
  ++at_;
}

std::vector<double> PosReader::list(char open, char close) {
  expect(open);
  const std::size_t end = content_.find(close, at_);
  if (end == std::string::npos) fail(fmt::format("a list has no '{}' at its end", close));
  const auto numbers = parse_numbers(std::string_view(content_).substr(at_, end - at_));
  if (!numbers) fail("a list is not of numbers alone");
  at_ = end + 1;
  return *numbers;
}

void PosReader::read_element(std::string_view name) {
  const auto kind = name.size() == 2 ? std::ranges::find(elements(), name[1], &Element::letter)
                                     : elements().end();
  const std::size_t n = name.size() == 2 ? components(name[0]) : 0;
  std::vector<double> coordinates = list('(', ')');
  std::vector<double> values = list('{', '}');
  expect(';');
  if (kind == elements().end() || n == 0) {  // texts, and elements of higher order
    ++left_out_;
    return;
  }
  if (components_ == 0) components_ = n;
  if (components_ != n) fail("scalars, vectors and tensors in one view are not read");
  const std::size_t corners = kind->order.size();
  if (coordinates.size() != 3 * corners || values.empty() || values.size() % (corners * n) != 0) {
    fail(fmt::format("{} has {} coordinates and {} values for {} corners", name, coordinates.size(),
                     values.size(), corners));
  }
  if (!values_.empty() && kinds_[0]->order.size() * values.size() != corners * values_[0].size()) {
    fail("has another number of time steps than the first element");
  }
  kinds_.push_back(&*kind);
  coordinates_.push_back(std::move(coordinates));
  values_.push_back(std::move(values));
}

std::uint32_t PosReader::point(const Eigen::Vector3d& place, std::span<const double> values) {
  std::vector<double> key = {place.x() + 0.0, place.y() + 0.0, place.z() + 0.0};
  key.insert(key.end(), values.begin(), values.end());
  const bool has_order =
      std::ranges::none_of(key, [](double x) { return x != x; });  // NaN equals nothing
  const auto number = static_cast<std::uint32_t>(mesh_.points.size());
  if (has_order) {
    const auto [entry, is_new] = numbers_.try_emplace(std::move(key), number);
    if (!is_new) return entry->second;
  }
  mesh_.points.push_back(place);
  mesh_.fields[0].values.insert(mesh_.fields[0].values.end(), values.begin(), values.end());
  return number;
}

/// Makes cells of the elements, with their values at that step.
void PosReader::choose_step(const std::string& time) {
  const std::size_t per_step = kinds_[0]->order.size() * components_;
  const std::size_t steps = values_[0].size() / per_step;
  if (!times_.empty() && times_.size() != steps) {
    fail(fmt::format("{} times for {} steps", times_.size(), steps));
  }
  for (std::size_t i = times_.size(); i < steps; ++i) times_.push_back(static_cast<double>(i));
  const std::size_t step = find_time_step(time, times_);
  note_time_step(mesh_.notes, step, times_);
  std::vector<std::uint32_t> cell;
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const std::size_t corners = kinds_[i]->order.size();
    cell.clear();
    for (const std::size_t c : kinds_[i]->order) {
      cell.push_back(
          point(Eigen::Vector3d(&coordinates_[i][3 * c]),
                std::span(values_[i]).subspan((step * corners + c) * components_, components_)));
    }
    mesh_.add_cell(kinds_[i]->type, cell);
  }
}

MeshData PosReader::read(const std::string& time) {
  if (name() != "View") fail("is no view of Gmsh in text: 'View' should be here");
  expect('"');
  const std::size_t quote = content_.find('"', at_);
  if (quote == std::string::npos) fail("the view's name has no end");
  const std::string title = content_.substr(at_, quote - at_);
  at_ = quote + 1;
  expect('{');
  while (true) {
    skip_spaces();
    if (at_ < content_.size() && content_[at_] == '}') break;
    const std::string_view word = name();
    if (word.empty()) fail("there should be an element or a '}' here");
    if (word == "TIME") {
      times_ = list('{', '}');
      expect(';');
    } else {
      read_element(word);
    }
  }
  ++at_;
  expect(';');
  if (kinds_.empty()) throw base::ReadError(file_, "has a view without elements that are read");
  mesh_.fields.push_back({title, Location::point, static_cast<int>(components_), {}});
  choose_step(time);
  if (left_out_ > 0) {
    mesh_.notes.push_back(
        fmt::format("{} texts and elements of higher order are left out", left_out_));
  }
  std::size_t corners = 0;
  for (const Element* kind : kinds_) corners += kind->order.size();
  mesh_.notes.push_back(
      fmt::format("{} corners became {} points: those of the same place and value "
                  "are one",
                  corners, mesh_.points.size()));
  if (content_.find("View", at_) != std::string::npos) {
    mesh_.notes.push_back("the first view of several is read");
  }
  return std::move(mesh_);
}

}  // namespace

MeshData read_pos(const std::string& file, const std::string& time) {
  return PosReader(file).read(time);
}

}  // namespace tetraglass::mesh
