// Beside VTK: time of a frame of a turning camera, and the error of the picture, of its two volume
// mappers for tetrahedra and of the projectors here, in one run. Needs a display for VTK's window:
// scripts/compare-peers makes one.
// usage: peers [FRAMES [DATA ...]]

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkProjectedTetrahedraMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include "base/errors.h"
#include "base/median.h"
#include "base/stopwatch.h"
#include "bench/random_delaunay.h"
#include "bench/vtk_grid.h"
#include "mesh/samples.h"
#include "project/cpu/cell_projector.h"
#include "project/gl/cell_projector.h"
#include "project/reference/reference.h"

namespace {

using namespace tetraglass;
using project::Image;
using project::Mode;

constexpr int kSize = 512;
constexpr int kVerified = 1000;  // pixels
constexpr double kTurn = 0.05;   // radians a frame

/// Over the range of the field, opacities relative to the diagonal.
preint::TransferFunction transfer_function(const std::string& name, const mesh::ScalarField& field,
                                           double diagonal) {
  const auto at = [&](double t) { return field.min + t * (field.max - field.min); };
  const auto color = [](double t) {
    return preint::Color(0.5 + 0.5 * std::sin(6 * t), t, 1 - t * t);
  };
  std::vector<preint::ControlPoint> points;
  if (name == "smooth") {  // 17 control points, nowhere 0
    for (int i = 0; i <= 16; ++i) {
      const double t = i / 16.0;
      points.push_back({at(t), color(t), (2 + 1.5 * std::sin(11 * t)) / diagonal});
    }
  } else {  // five peaks, 0 between them
    for (int i = 0; i < 5; ++i) {
      const double t = 0.1 + 0.2 * i;
      points.push_back({at(t - 0.02), color(t), 0});
      points.push_back({at(t), color(t), 40 / diagonal});
      points.push_back({at(t + 0.02), color(t), 0});
    }
  }
  return preint::TransferFunction(points);
}

/// One program's way to draw a scene from a view.
struct Contender {
  std::string name;
  std::function<void(const project::Camera&)> draw;
  std::function<Image()> picture;  ///< of the last view
  Mode mode = Mode::full;
  std::vector<double> times = {};
};

/// VTK's objects for one data set and transfer function.
class VtkScene {
 public:
  VtkScene(const project::Scene& scene, vtkUnstructuredGridVolumeMapper* mapper) : mapper_(mapper) {
    const vtkNew<vtkUnstructuredGrid> grid = bench::vtk_grid(*scene.mesh);
    vtkNew<vtkDoubleArray> values;
    values->SetName("field");
    for (const double value : scene.field.values) values->InsertNextValue(value);
    grid->GetPointData()->SetScalars(values);
    // Opacities must not exceed 1: they are given per unit distance of the largest extinction.
    const auto& control = scene.transfer_function.points();
    double most = 0;
    for (const preint::ControlPoint& p : control) most = std::max(most, p.extinction);
    vtkNew<vtkColorTransferFunction> colors;
    vtkNew<vtkPiecewiseFunction> opacities;
    for (const preint::ControlPoint& p : control) {
      colors->AddRGBPoint(p.value, p.color[0], p.color[1], p.color[2]);
      opacities->AddPoint(p.value, p.extinction / most);
    }
    vtkNew<vtkVolumeProperty> property;
    property->SetColor(colors);
    property->SetScalarOpacity(opacities);
    property->SetScalarOpacityUnitDistance(1 / most);
    property->SetInterpolationTypeToLinear();
    property->ShadeOff();
    mapper->SetInputData(grid);
    vtkNew<vtkVolume> volume;
    volume->SetMapper(mapper);
    volume->SetProperty(property);
    renderer_->AddVolume(volume);
    renderer_->SetBackground(0, 0, 0);
    window_->SetMultiSamples(0);
    window_->SetSize(kSize, kSize);
    window_->AddRenderer(renderer_);
  }

  void draw(const project::Camera& camera) {
    vtkCamera* view = renderer_->GetActiveCamera();
    view->SetPosition(camera.eye.data());
    view->SetFocalPoint(camera.target.data());
    view->SetViewUp(camera.up.data());
    view->SetViewAngle(camera.fov_degrees);
    renderer_->ResetCameraClippingRange();
    window_->Render();
    window_->WaitForCompletion();
  }

  Image picture() {
    vtkNew<vtkUnsignedCharArray> bytes;
    window_->GetRGBACharPixelData(0, 0, kSize - 1, kSize - 1, 1, bytes);
    Image image(kSize, kSize);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        for (int c = 0; c < 3; ++c) {
          image.pixel(x, y)[c] =
              static_cast<float>(bytes->GetValue(4 * ((kSize - 1 - y) * kSize + x) + c) / 255.0);
        }
      }
    }
    return image;
  }

 private:
  vtkSmartPointer<vtkUnstructuredGridVolumeMapper> mapper_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
};

Contender vtk(const std::string& name, const project::Scene& scene,
              vtkUnstructuredGridVolumeMapper* mapper) {
  auto own = std::make_shared<VtkScene>(scene, mapper);
  return {name, [own](const project::Camera& camera) { own->draw(camera); },
          [own] { return own->picture(); }};
}

template <class Projector>
Contender own(const std::string& name, std::shared_ptr<Projector> projector,
              Mode mode = Mode::full) {
  auto image = std::make_shared<Image>();
  return {name,
          [=](const project::Camera& camera) {
            project::Stats stats;
            *image = projector->draw(project::Frame(camera, kSize, kSize), stats);
          },
          [=] { return *image; }, mode};
}

/// Red, green and blue over black, of 255: what a screen shows.
struct Errors {
  double largest = 0;
  double rms = 0;
};

Errors errors(const Image& image, const std::vector<Eigen::Vector2i>& pixels,
              const std::vector<Eigen::Array4d>& expected) {
  Errors result;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double shown = image.pixel(pixels[i].x(), pixels[i].y())[c];
      const double error = 255 * std::abs(std::min(1.0, shown) - std::min(1.0, expected[i][c]));
      result.largest = std::max(result.largest, error);
      result.rms += error * error;
    }
  }
  result.rms = std::sqrt(result.rms / (3.0 * static_cast<double>(pixels.size())));
  return result;
}

project::Camera camera_at(const mesh::TetMesh& mesh, int frame) {
  const double angle = 0.7 + kTurn * frame;
  return project::frame_camera(mesh::bounds(mesh), {std::cos(angle), std::sin(angle), 0.6},
                               Eigen::Vector3d::UnitZ(), 30, 1);
}

void compare(const std::string& name, const mesh::TetMesh& mesh, const std::string& function,
             const project::gl::Context& context, int frames) {
  project::Scene scene;
  scene.mesh = &mesh;
  scene.field = mesh::select_scalar(mesh, "");
  scene.drawable = mesh::find_drawable(mesh, scene.field);
  scene.transfer_function =
      transfer_function(function, scene.field, mesh::bounds(mesh).diagonal().norm());
  scene.mode = Mode::full;
  scene.width = scene.height = kSize;
  std::vector<Contender> all;
  vtkNew<vtkProjectedTetrahedraMapper> projected;
  all.push_back(vtk("vtkProjectedTetrahedraMapper", scene, projected));
  vtkNew<vtkUnstructuredGridVolumeRayCastMapper> cast;
  vtkNew<vtkUnstructuredGridLinearRayIntegrator> linear;
  cast->SetRayIntegrator(linear);
  cast->SetAutoAdjustSampleDistances(0);
  cast->SetImageSampleDistance(1);
  all.push_back(vtk("vtkUnstructuredGridVolumeRayCastMapper, linear", scene, cast));
  project::Request request;
  request.projector = project::Projector::cpu;
  const auto add_cpu = [&](const std::string& what, const project::Scene& drawn) {
    all.push_back(
        own("cpu, " + what,
            std::make_shared<project::cpu::CellProjector>(drawn, project::plan(drawn, request)),
            drawn.mode));
  };
  add_cpu("exact at every pixel", scene);
  request.sort = project::SortMethod::mpvo;
  add_cpu("mpvo", scene);
  request.sort.reset();
  // VTK's mappers have no such modes for tetrahedra: the time of theirs is that of full.
  project::Scene emission = scene;
  emission.mode = Mode::emission;
  add_cpu("emission", emission);
  project::Scene largest = scene;
  largest.mode = Mode::mip;
  add_cpu("mip", largest);
  request.projector = project::Projector::gl;
  project::Stats stats;
  all.push_back(
      own("gl (OSMesa), mpvo", std::make_shared<project::gl::CellProjector>(
                                   context, scene, project::plan(scene, request), stats)));
  context.release();
  for (int frame = -1; frame < frames; ++frame) {  // the first one is not counted: set-up
    const project::Camera camera = camera_at(mesh, frame);
    for (Contender& contender : all) {
      const base::Stopwatch clock;
      contender.draw(camera);
      if (frame >= 0) contender.times.push_back(clock.milliseconds());
      context.release();  // VTK makes its own current
    }
  }
  scene.camera = camera_at(mesh, frames - 1);
  std::mt19937 random;
  std::vector<Eigen::Vector2i> pixels;
  for (int i = 0; i < kVerified; ++i) {
    const int x = static_cast<int>(random() % kSize);
    pixels.emplace_back(x, static_cast<int>(random() % kSize));
  }
  const double slowest = base::median(all.front().times);
  for (const Contender& contender : all) {
    scene.mode = contender.mode;
    const Errors error =
        errors(contender.picture(), pixels, project::reference_pixels(scene, pixels));
    const double time = base::median(contender.times);
    fmt::print("| {} | {} | {} | {} | {:.1f} | {:.2f} | {:.2g} | {:.2g} |\n", name,
               scene.drawable.cells.size(), function, contender.name, time, slowest / time,
               error.rms, error.largest);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::max(1, std::atoi(argv[1])) : 9;
  std::vector<std::string> names(argv + std::min(argc, 2), argv + argc);
  if (names.empty()) names = {"sphere", "orbital", "delaunay", "orbital-1m"};
  try {
    const auto context = project::gl::Context::create(project::ContextKind::osmesa);
    fmt::print(
        "{0} x {0} pixels, mode full where no other is named, medians of {1} frames of a turning "
        "camera, taken in turn. "
        "Errors of\nred, green and blue of 255 against the reference at {2} random pixels.\n\n"
        "| data | cells | transfer function | by | ms | times as fast as the first | RMS error | "
        "largest |\n|---|---:|---|---|---:|---:|---:|---:|\n",
        kSize, frames, kVerified);
    for (const std::string& name : names) {
      const mesh::TetMesh mesh = name == "delaunay"     ? bench::random_delaunay(23000)
                                 : name == "orbital-1m" ? mesh::make_sample("orbital", 1000000)
                                                        : mesh::make_sample(name);
      for (const std::string function : {"smooth", "peaks"}) {
        compare(name, mesh, function, *context, frames);
      }
    }
  } catch (const base::Error& error) {
    fmt::print(stderr, "peers: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
