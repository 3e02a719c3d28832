#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "apps/ink.h"
#include "project/camera.h"

namespace tetraglass::apps {

/// Axes along three edges of a box, with ticks and numbers in the mesh's coordinates: on the
/// outline of the box in the picture, so that neither they nor their labels, which lie outside,
/// cross what is in the box.
class BoxAxes {
 public:
  /// Of `all` pixels, which show the box through the frame (of one ray a pixel). `scale`: 1 in a
  /// picture of 800 x 600 pixels.
  BoxAxes(const Eigen::AlignedBox3d& box, const project::Frame& frame, double scale);

  /// The axes (0: x, 1: y, 2: z) that are shown: not those seen end on, and none where the eye is
  /// in the box or beside it so that edges reach behind the eye.
  [[nodiscard]] const std::vector<int>& shown() const { return shown_; }

  /// What axes, labels and the box take up, in pixels; empty where the box reaches behind the eye.
  [[nodiscard]] const Eigen::AlignedBox2d& extent() const { return extent_; }

  /// Where the labels are, in pixels.
  [[nodiscard]] const std::vector<Eigen::AlignedBox2d>& label_places() const { return places_; }

  /// `origin`: where the frame's picture starts in that of the ink.
  void draw(const Eigen::Vector2d& origin, Ink& ink) const;

 private:
  struct Label {
    std::string text;
    Eigen::Vector2d middle;
    bool is_name = false;
  };
  struct Line {
    Eigen::Vector2d from;
    Eigen::Vector2d to;
  };

  struct Edge {
    Eigen::Vector3d from;
    Eigen::Vector3d to;
  };
  void add_axis(int axis, const Edge& edge, const project::Frame& frame,
                const Eigen::Vector2d& middle);
  void add_label(const Label& label);

  double scale_;
  Font font_;
  Font name_font_;
  std::vector<int> shown_;
  std::vector<Label> labels_;
  std::vector<Eigen::AlignedBox2d> places_;  // of the labels
  std::vector<Line> lines_;
  Eigen::AlignedBox2d extent_;
};

}  // namespace tetraglass::apps
