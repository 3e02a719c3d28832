#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "preint/transfer_function.h"

namespace tetraglass::apps::view {

/// The control points of a transfer function while they are edited, and the way back.
class TransferFunctionEditor {
 public:
  using Points = std::vector<preint::ControlPoint>;

  /// As many points as a hand can hold apart.
  static constexpr std::size_t kMostPoints = 10;

  /// Follows a function that is not edited, that of `source` (a preset, a file), by at most
  /// kMostPoints points, or all of its own where it has few. Returns how far color and extinction
  /// differ from it at most, in parts of their largest values. A change from another source or from
  /// edited points can be undone.
  double follow(const preint::TransferFunction& tf, const std::string& source);
  /// Nothing is left to undo: the field is another one.
  void forget();

  [[nodiscard]] const Points& points() const { return now_.points; }
  [[nodiscard]] std::size_t selected() const { return now_.selected; }
  void select(std::size_t point);

  /// Whether the points were edited since `follow`, and are what is to be drawn.
  [[nodiscard]] bool edited() const { return now_.edited; }
  /// What is followed, or was before the points were edited.
  [[nodiscard]] const std::string& source() const { return now_.source; }
  [[nodiscard]] preint::TransferFunction function() const {
    return preint::TransferFunction(now_.points);
  }

  /// Changes from here on are undone together, until the next `begin`: a drag.
  void begin();

  /// A new point on the function, selected.
  void add(double value);
  /// The selected point; it stays between its neighbours. Extinction below 0 is 0.
  void move(double value, double extinction);
  void set_color(const preint::Color& color);
  /// The selected point, unless it is the only one.
  void remove();

  [[nodiscard]] bool can_undo() const { return !past_.empty(); }
  [[nodiscard]] bool can_redo() const { return !future_.empty(); }
  void undo();
  void redo();

 private:
  struct State {
    Points points{preint::ControlPoint{}};
    std::size_t selected = 0;
    bool edited = false;
    std::string source;
  };
  /// Before any change.
  void remember();

  State now_;
  bool remembered_ = false;  // since `begin`
  std::vector<State> past_;
  std::vector<State> future_;
};

}  // namespace tetraglass::apps::view
