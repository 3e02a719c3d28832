#include "sort/cell_sorter.h"

#include <variant>

#include "base/errors.h"
#include "sort/centroid.h"
#include "sort/mpvo.h"
#include "sort/power.h"

namespace tetraglass::sort {
namespace {

using AnySorter = std::variant<CentroidSorter, PowerSorter, MpvoSorter>;

AnySorter make(Method method, const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
               std::span<const double> weights) {
  switch (method) {
    case Method::centroid:
      return CentroidSorter(mesh, cells);
    case Method::power:
      return PowerSorter(mesh, cells, weights);
    case Method::mpvo:
      return MpvoSorter(mesh, cells);
    case Method::none:
    case Method::fragments:
      break;
  }
  throw base::UsageError("'" + to_string(method) +
                         "' does not order cells; there are: centroid, power, mpvo");
}

}  // namespace

struct CellSorter::Sorter {
  AnySorter any;
};

CellSorter::CellSorter(Method method, const mesh::TetMesh& mesh,
                       std::span<const std::uint32_t> cells, std::span<const double> weights)
    : sorter_(new Sorter{make(method, mesh, cells, weights)}) {}
CellSorter::CellSorter(CellSorter&&) noexcept = default;
CellSorter& CellSorter::operator=(CellSorter&&) noexcept = default;
CellSorter::~CellSorter() = default;

const Order& CellSorter::sort(const View& view) {
  return std::visit([&](auto& sorter) -> const Order& { return sorter.sort(view); }, sorter_->any);
}

std::string to_string(Method method) {
  switch (method) {
    case Method::none:
      return "none";
    case Method::centroid:
      return "centroid";
    case Method::power:
      return "power";
    case Method::mpvo:
      return "mpvo";
    case Method::fragments:
      return "fragments";
  }
  return "";
}

}  // namespace tetraglass::sort
