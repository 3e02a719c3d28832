#pragma once

#include <optional>

namespace tetraglass::apps::view {

/// Decides how coarsely pictures are drawn while the view or the scene moves, and when a picture is
/// drawn finely. Coarseness n: each pixel drawn covers n x n pixels of the window.
class Pacing {
 public:
  /// A picture while moving shall take no longer than this.
  static constexpr double kMovingMs = 80;
  /// Nothing has moved for so long: at rest.
  static constexpr double kRestMs = 150;
  static constexpr int kCoarsest = 6;

  /// The view or the scene changed, at this time (milliseconds on any clock).
  void changed(double now_ms);

  /// What to draw next, where nothing is being drawn: nothing, or a picture of this coarseness.
  [[nodiscard]] std::optional<int> next(double now_ms) const;

  /// That picture is being drawn.
  void started(int coarseness);

  /// It took so long to draw.
  void finished(double ms);

  /// It was given up before it was ready.
  void interrupted();

  /// Whether what is being drawn is the picture at rest of what has changed since: there is a
  /// coarser one of it, and nobody waits for this one.
  [[nodiscard]] bool outdated() const { return drawing_ && refining_ && !drawn_; }

  /// It could not be drawn; nothing is tried again until something changes.
  void failed();

  /// How long until `next` may answer otherwise; nothing where only a change makes it so.
  [[nodiscard]] std::optional<double> wait_ms(double now_ms) const;

  /// Whether the last picture drawn is of what is wanted, in full.
  [[nodiscard]] bool complete() const { return drawn_ && *drawn_ == 1 && !drawing_; }

  [[nodiscard]] bool drawing() const { return drawing_.has_value(); }

  /// Of pictures while moving.
  [[nodiscard]] int coarseness() const { return coarseness_; }

 private:
  int coarseness_ = 2;
  double changed_ms_ = 0;
  std::optional<int> drawn_;  // how coarsely what is wanted now was drawn, or is being drawn
  std::optional<int> drawing_;
  bool refining_ = false;
};

}  // namespace tetraglass::apps::view
