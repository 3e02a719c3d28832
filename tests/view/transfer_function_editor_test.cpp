#include "apps/view/transfer_function_editor.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "preint/transfer_function_edit.h"

namespace tetraglass::apps::view {
namespace {

using preint::ControlPoint;
using preint::TransferFunction;

TransferFunction tent() {
  return TransferFunction({{0, {0, 0, 1}, 0}, {1, {0, 1, 0}, 4}, {2, {1, 0, 0}, 0}});
}

TransferFunctionEditor edit_tent() {
  TransferFunctionEditor editor;
  editor.follow(tent(), "tent");
  return editor;
}

TEST(TransferFunctionEditor, FollowsWithinItsToleranceByFewPoints) {
  preint::Histogram histogram{0, 1, {}};
  for (int i = 0; i < 64; ++i) {
    histogram.counts.push_back(static_cast<std::uint64_t>(1000 * std::exp(-0.1 * i)));
  }
  const TransferFunction tf =
      preint::automatic_extinction(preint::preset("viridis", 0, 1, 2), histogram, 3, 2);
  TransferFunctionEditor editor;
  const double tolerance = editor.follow(tf, "viridis");
  EXPECT_GT(tf.points().size(), 50U);
  EXPECT_LE(editor.points().size(), TransferFunctionEditor::kMostPoints);
  EXPECT_LT(tolerance, 0.1);
  EXPECT_FALSE(editor.edited());
  const double most = tf.max_extinction(0, 1);
  const TransferFunction few = editor.function();
  for (int i = 0; i <= 1000; ++i) {
    const double value = i / 1000.0;
    constexpr double kRoundings = 1e-12;
    EXPECT_LE(std::abs(few.at(value).extinction - tf.at(value).extinction) / most,
              tolerance + kRoundings);
    EXPECT_LE((few.at(value).color - tf.at(value).color).abs().maxCoeff(), tolerance + kRoundings);
  }
}

TEST(TransferFunctionEditor, FewPointsAreFollowedExactly) {
  TransferFunctionEditor editor;
  EXPECT_EQ(editor.follow(tent(), "tent"), 0);
  EXPECT_EQ(editor.points().size(), tent().points().size());
}

TEST(TransferFunctionEditor, APointStaysBetweenItsNeighbours) {
  TransferFunctionEditor editor = edit_tent();
  editor.select(1);
  editor.begin();
  editor.move(5, -3);
  EXPECT_EQ(editor.points()[1].value, 2);
  EXPECT_EQ(editor.points()[1].extinction, 0);
  editor.move(-5, 2);
  EXPECT_EQ(editor.points()[1].value, 0);
  EXPECT_EQ(editor.points()[1].extinction, 2);
  editor.move(std::numeric_limits<double>::quiet_NaN(), 2);
  EXPECT_EQ(editor.points()[1].value, 0);
}

// Three points of one value are no transfer function; no way of dragging and adding makes some.
TEST(TransferFunctionEditor, WhateverIsDoneItIsATransferFunction) {
  TransferFunctionEditor editor = edit_tent();
  for (int i = 0; i < 400; ++i) {
    const double value = static_cast<double>(i * 7919 % 5) / 2;
    editor.begin();
    switch (i * 104729 % 6) {
      case 0:
      case 1:
        editor.add(value);
        break;
      case 2:
        editor.remove();
        break;
      case 3:
        editor.undo();
        break;
      default:
        editor.select(static_cast<std::size_t>(i) % editor.points().size());
        editor.move(value, i % 3);
    }
    ASSERT_NO_THROW((void)editor.function()) << "step " << i;
  }
}

TEST(TransferFunctionEditor, AnAddedPointChangesNothingYet) {
  TransferFunctionEditor editor = edit_tent();
  editor.begin();
  editor.add(0.25);
  EXPECT_EQ(editor.selected(), 1U);
  EXPECT_EQ(editor.points().size(), 4U);
  EXPECT_EQ(editor.function().at(0.25).extinction, 1);
  EXPECT_EQ(editor.function().at(0.75).extinction, 3);
}

TEST(TransferFunctionEditor, ADragIsUndoneAtOnce) {
  TransferFunctionEditor editor = edit_tent();
  editor.select(1);
  editor.begin();
  for (int i = 0; i < 10; ++i) editor.move(1 + 0.05 * i, i);
  editor.begin();
  editor.set_color({1, 1, 1});
  EXPECT_TRUE(editor.edited());
  editor.undo();
  EXPECT_EQ(editor.points()[1].extinction, 9);
  EXPECT_EQ(editor.points()[1].color[0], 0);
  editor.undo();
  EXPECT_EQ(editor.points()[1].value, 1);
  EXPECT_FALSE(editor.edited());
  EXPECT_FALSE(editor.can_undo());
  editor.redo();
  EXPECT_EQ(editor.points()[1].extinction, 9);
  editor.redo();
  EXPECT_EQ(editor.points()[1].color[0], 1);
  EXPECT_FALSE(editor.can_redo());
}

TEST(TransferFunctionEditor, AnotherPresetCanBeUndone) {
  TransferFunctionEditor editor = edit_tent();
  editor.select(1);
  editor.begin();
  editor.move(1, 7);
  editor.follow(TransferFunction({{0, {1, 1, 1}, 1}}), "flat");
  EXPECT_EQ(editor.source(), "flat");
  EXPECT_FALSE(editor.edited());
  editor.undo();
  EXPECT_EQ(editor.source(), "tent");
  EXPECT_TRUE(editor.edited());
  EXPECT_EQ(editor.points()[1].extinction, 7);
  // The same source again, for another range say, is no step.
  editor.undo();
  editor.follow(tent(), "tent");
  EXPECT_FALSE(editor.can_undo());
}

TEST(TransferFunctionEditor, TheLastPointStays) {
  TransferFunctionEditor editor = edit_tent();
  for (int i = 0; i < 5; ++i) {
    editor.begin();
    editor.remove();
  }
  EXPECT_EQ(editor.points().size(), 1U);
}

}  // namespace
}  // namespace tetraglass::apps::view
