#include "project/accuracy_study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

mesh::TetMesh ball() {
  return tests::box({-1, -1, -1}, {1, 1, 1}, 4, 4, 4, [](const auto& p) { return p.norm(); });
}

Scene scene_of(const mesh::TetMesh& mesh, Mode mode) {
  return tests::make_scene(
      mesh, mode,
      preint::TransferFunction({{0, {1, 0.2, 0}, 0}, {0.8, {1, 1, 0.3}, 3}, {1.8, {0, 0, 1}, 1}}),
      24);
}

StudyPoint point(double ms, double error, const std::string& failure = "") {
  StudyPoint result;
  result.frame_ms = ms;
  result.error.max = error;
  result.failure = failure;
  return result;
}

TEST(AccuracyStudy, FrontIsWhatNothingBeats) {
  std::vector<StudyPoint> points = {point(1, 0.5),  point(2, 0.1), point(3, 0.2),
                                    point(4, 0.01), point(4, 0.3), point(0.5, 0, "no context"),
                                    point(9, 0.01)};
  mark_front(points);
  std::vector<bool> front;
  for (const StudyPoint& one : points) front.push_back(one.on_front);
  EXPECT_EQ(front, (std::vector<bool>{true, true, false, true, false, false, false}));
}

TEST(AccuracyStudy, CasesAreThoseOfTheMode) {
  const mesh::TetMesh mesh = ball();
  const auto names = [&](Mode mode) {
    const Scene scene = scene_of(mesh, mode);
    std::set<std::string> result;
    for (const StudyCase& one : study_cases(scene, false)) {
      EXPECT_NO_THROW((void)plan(scene, one.request)) << one.name;
      EXPECT_TRUE(result.insert(one.name).second) << one.name << " twice";
    }
    return result;
  };
  const std::set<std::string> full = names(Mode::full);
  for (const char* name :
       {"cpu", "gl", "gl, linear", "gl, table3d 64x32", "gl, psi 256", "gl, centroid",
        "gl, fragments", "gl, faces12, no edge fix", "gl, rgba8"}) {
    EXPECT_EQ(full.count(name), 1U) << name;
  }
  const std::set<std::string> emission = names(Mode::emission);
  EXPECT_EQ(emission.count("gl, table2d 256"), 1U);
  EXPECT_EQ(emission.count("gl, fragments"), 0U) << "needs no order";
  EXPECT_EQ(emission.count("gl, table3d 64x32"), 0U);
  EXPECT_EQ(names(Mode::thickness).count("gl, rgba8"), 0U) << "lengths are no colors";
}

TEST(AccuracyStudy, ErrorsAreThoseOfTheWay) {
  const mesh::TetMesh mesh = ball();
  const Scene scene = scene_of(mesh, Mode::full);
  std::vector<StudyCase> cases = study_cases(scene, false);
  std::erase_if(cases, [](const StudyCase& one) {
    return one.name != "cpu" && one.name != "gl" && one.name != "gl, linear" &&
           one.name != "gl, rgba8";
  });
  std::size_t steps = 0;
  const Study study = study_accuracy(scene, cases, {2, 1e9}, [&] { ++steps; });
  EXPECT_EQ(steps, 2 * cases.size());
  ASSERT_EQ(study.points.size(), cases.size() + 1);
  const auto error = [&](const std::string& name) {
    const auto found = std::find_if(study.points.begin(), study.points.end(),
                                    [&](const StudyPoint& one) { return one.what.name == name; });
    EXPECT_NE(found, study.points.end()) << name;
    EXPECT_EQ(found->failure, "");
    EXPECT_GT(found->frame_ms, 0);
    EXPECT_EQ(found->image.rgba.size(), study.reference.rgba.size());
    return found->error.max;
  };
  EXPECT_EQ(error("reference"), 0);
  EXPECT_LT(error("cpu"), 1e-4);
  EXPECT_LT(error("gl"), 1e-4);
  EXPECT_GT(error("gl, linear"), 1e-3);
  EXPECT_GT(error("gl, rgba8"), 1e-3);
  EXPECT_TRUE(std::any_of(study.points.begin(), study.points.end(),
                          [](const StudyPoint& one) { return one.on_front; }));
}

TEST(AccuracyStudy, SlicesAreJudgedByTheGridTheyDraw) {
  const mesh::TetMesh mesh =
      tests::box({0, 0, 0}, {1, 1, 1}, 8, 8, 8, [](const Eigen::Vector3d& p) {
        return 0.5 + 0.5 * std::sin(6 * p.x() + 4 * p.y()) * std::cos(5 * p.z());
      });
  Scene scene = scene_of(mesh, Mode::full);
  for (const StudyCase& one : study_cases(scene, true)) EXPECT_FALSE(draws_grid(one)) << one.name;
  scene.grid = mesh::rectilinear_grid(mesh);
  std::vector<StudyCase> cases = study_cases(scene, false);
  std::erase_if(cases, [](const StudyCase& one) { return !draws_grid(one) && one.name != "cpu"; });
  const Study study = study_accuracy(scene, cases, {1, 1e9}, [] {});
  ASSERT_FALSE(study.grid_reference.rgba.empty());
  EXPECT_GT(compare(study.reference, study.grid_reference).max, 1e-3) << "they are other fields";
  std::map<std::string, double> errors;
  for (const StudyPoint& one : study.points) errors[one.what.name] = one.error.max;
  EXPECT_EQ(errors.at("grid-reference"), 0);
  EXPECT_LT(errors.at("slices, integrated 256"), 1e-3);
  EXPECT_LT(errors.at("slices, integrated 256"), errors.at("slices, integrated 64"));
  EXPECT_LT(errors.at("cpu"), 1e-4);
}

TEST(AccuracyStudy, ShadingsAreJudgedByLightAtEveryPoint) {
  const mesh::TetMesh mesh = ball();
  Scene scene = scene_of(mesh, Mode::full);
  scene.shading = Shading::single;
  std::vector<StudyCase> cases = study_cases(scene, false);
  std::erase_if(cases,
                [](const StudyCase& one) { return one.name != "cpu" && one.knob != "shading"; });
  ASSERT_EQ(cases.size(), 7U);
  const Study study = study_accuracy(scene, cases, {1, 1e9}, [] {});
  std::map<std::string, double> errors;
  for (const StudyPoint& one : study.points) errors[one.what.name] = one.error.rms;
  for (const char* quick : {"cpu", "cpu, weighted", "cpu, interpolated"}) {
    EXPECT_LT(errors.at("cpu, smooth"), errors.at(quick));
    EXPECT_LT(errors.at(quick), errors.at("cpu, none"));
  }
}

TEST(AccuracyStudy, KeepsToItsTime) {
  const mesh::TetMesh mesh = ball();
  const Scene scene = scene_of(mesh, Mode::thickness);
  std::vector<StudyCase> cases = study_cases(scene, false);
  cases.resize(2);
  const Study none = study_accuracy(scene, cases, {5, 0}, [] {});
  EXPECT_EQ(none.rounds, 1);
  EXPECT_EQ(none.points[1].failure, "");
  EXPECT_NE(none.points[2].failure, "") << "the time was up";
  EXPECT_FALSE(none.points[2].on_front);
  const Study all = study_accuracy(scene, cases, {5, 1e9}, [] {});
  EXPECT_EQ(all.rounds, 5);
  EXPECT_EQ(all.points[2].failure, "");
}

}  // namespace
}  // namespace tetraglass::project
