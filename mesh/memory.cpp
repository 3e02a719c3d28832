#include "mesh/memory.h"

#include <cstdint>
#include <limits>

#include <fmt/format.h>
#include <unistd.h>

#include "base/errors.h"
#include "mesh/mesh_data.h"
#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

void check_mesh_fits(std::size_t points, std::size_t cells) {
  constexpr double kPartsPerCell = 6;
  const auto bytes =
      static_cast<double>(points) * 2 * sizeof(Eigen::Vector3d) +  // as read, and of the result
      static_cast<double>(cells) *
          (sizeof(CellType) + sizeof(std::uint64_t) + 8 * sizeof(std::uint32_t) +
           kPartsPerCell * (sizeof(Cell) + sizeof(std::size_t)));
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (bytes > memory) {
    constexpr double kGigabyte = 1e9;
    throw base::InputError(fmt::format(
        "{} points and {} cells would take {:.3g} GB of memory; this machine has {:.3g} GB", points,
        cells, bytes / kGigabyte, memory / kGigabyte));
  }
  if (points >= std::numeric_limits<std::uint32_t>::max()) {
    throw base::InputError(
        fmt::format("{} points are more than can be numbered in 32 bits", points));
  }
}

}  // namespace tetraglass::mesh
