#include "mesh/adjacency.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <memory>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace tetraglass::mesh {
namespace {

// A face on its way to its partner. The smallest vertex is kept as its place within its partition.
struct Face {
  std::uint32_t middle;
  std::uint32_t largest;
  std::uint32_t cell;
  std::uint32_t smallest_and_face;  // 4 * place + face

  [[nodiscard]] std::uint64_t key() const {
    return static_cast<std::uint64_t>(middle) << 32 | largest;
  }
};

// How the faces are spread over partitions: by blocks of 2^shift neighbouring smallest vertices. A
// partition should fit the second-level cache (64 K faces are 1 MB), and there should not be more
// of them than write streams that the machine follows well.
constexpr std::size_t kFacesPerPartition = 16384;
constexpr std::size_t kMostPartitions = 512;
constexpr std::size_t kCellsPerChunk = 32768;

struct Layout {
  explicit Layout(const TetMesh& mesh) {
    const std::size_t wanted =
        std::clamp(4 * mesh.cells.size() / kFacesPerPartition, std::size_t{1}, kMostPartitions);
    const std::size_t per_partition = mesh.points.size() / wanted + 1;
    shift = std::bit_width(per_partition - 1);
    partitions = (mesh.points.size() >> shift) + 1;
    chunks = (mesh.cells.size() + kCellsPerChunk - 1) / kCellsPerChunk;
  }
  int shift = 0;
  std::size_t partitions = 0;
  std::size_t chunks = 0;
};

// Calls f(smallest, middle, largest, face) for the four faces of a cell.
template <typename F>
void for_each_face(const Cell& cell, const F& f) {
  for (std::uint32_t face = 0; face < 4; ++face) {
    const auto& v = kFaceVertices[face];
    const std::uint32_t a = cell[static_cast<std::size_t>(v[0])];
    const std::uint32_t b = cell[static_cast<std::size_t>(v[1])];
    const std::uint32_t c = cell[static_cast<std::size_t>(v[2])];
    const std::uint32_t low = std::min(a, b);
    const std::uint32_t high = std::max(a, b);
    f(std::min(low, c), std::max(low, std::min(high, c)), std::max(high, c), face);
  }
}

// All faces, partition after partition, and where each partition begins.
struct Partitioned {
  std::unique_ptr<Face[]> faces;
  std::vector<std::size_t> begins;
};

Partitioned partition_faces(const TetMesh& mesh, const Layout& layout) {
  const std::size_t partitions = layout.partitions;
  std::vector<std::size_t> places(layout.chunks * partitions, 0);
  const auto for_each_cell = [&](std::size_t chunk, const auto& f) {
    const std::size_t end = std::min(mesh.cells.size(), (chunk + 1) * kCellsPerChunk);
    for (std::size_t cell = chunk * kCellsPerChunk; cell < end; ++cell) f(cell);
  };
  tbb::parallel_for(std::size_t{0}, layout.chunks, [&](std::size_t chunk) {
    std::size_t* counts = places.data() + chunk * partitions;
    for_each_cell(chunk, [&](std::size_t cell) {
      // Only the smallest vertex of each face counts: the smallest of the cell for three of them.
      const Cell& c = mesh.cells[cell];
      const std::uint32_t ab = std::min(c[0], c[1]);
      const std::uint32_t cd = std::min(c[2], c[3]);
      ++counts[std::min(c[1], cd) >> layout.shift];
      ++counts[std::min(c[0], cd) >> layout.shift];
      ++counts[std::min(ab, c[3]) >> layout.shift];
      ++counts[std::min(ab, c[2]) >> layout.shift];
    });
  });

  Partitioned result;
  result.begins.resize(partitions + 1);
  std::size_t place = 0;
  for (std::size_t partition = 0; partition < partitions; ++partition) {
    result.begins[partition] = place;
    for (std::size_t chunk = 0; chunk < layout.chunks; ++chunk) {
      place += std::exchange(places[chunk * partitions + partition], place);
    }
  }
  result.begins[partitions] = place;

  result.faces = std::make_unique_for_overwrite<Face[]>(place);
  Face* faces = result.faces.get();
  const std::uint32_t mask = (std::uint32_t{1} << layout.shift) - 1;
  tbb::parallel_for(std::size_t{0}, layout.chunks, [&](std::size_t chunk) {
    std::size_t* mine = places.data() + chunk * partitions;
    for_each_cell(chunk, [&](std::size_t cell) {
      for_each_face(mesh.cells[cell], [&](auto smallest, auto middle, auto largest, auto face) {
        faces[mine[smallest >> layout.shift]++] = {
            middle, largest, static_cast<std::uint32_t>(cell), (smallest & mask) << 2 | face};
      });
    });
  });
  return result;
}

struct Tally {
  std::size_t boundary = 0;
  std::size_t crowded = 0;
};

// Links the faces of one smallest vertex.
Tally link_bucket(Face* begin, Face* end, Adjacency& adjacency) {
  const auto before = [](const Face& a, const Face& b) { return a.key() < b.key(); };
  constexpr std::ptrdiff_t kFew = 64;  // some 24 faces are usual; a hub of many cells has far more
  if (end - begin > kFew) {
    std::sort(begin, end, before);
  } else {
    for (Face* i = begin; i != end; ++i) {
      const Face moved = *i;
      Face* hole = i;
      for (; hole != begin && before(moved, *(hole - 1)); --hole) *hole = *(hole - 1);
      *hole = moved;
    }
  }
  Tally tally;
  for (Face* first = begin; first != end;) {
    Face* last = first + 1;
    while (last != end && last->key() == first->key()) ++last;
    if (last - first == 1) {
      ++tally.boundary;
    } else if (last - first == 2 && first[0].cell != first[1].cell) {
      adjacency.neighbors[first[0].cell][first[0].smallest_and_face & 3] = first[1].cell;
      adjacency.neighbors[first[1].cell][first[1].smallest_and_face & 3] = first[0].cell;
    } else {
      ++tally.crowded;
    }
    first = last;
  }
  return tally;
}

struct Workspace {
  std::vector<std::uint32_t> ends;
  std::vector<Face> faces;
};

// Links the faces of a partition: a counting sort by smallest vertex, then vertex after vertex.
Tally link_partition(const Face* begin, const Face* end, const Layout& layout, Workspace& work,
                     Adjacency& adjacency) {
  const std::size_t vertices = std::size_t{1} << layout.shift;
  work.ends.assign(vertices + 1, 0);
  if (work.faces.size() < static_cast<std::size_t>(end - begin)) {
    work.faces.resize(static_cast<std::size_t>(end - begin));
  }
  for (const Face* face = begin; face != end; ++face) {
    ++work.ends[(face->smallest_and_face >> 2) + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) work.ends[v + 1] += work.ends[v];
  for (const Face* face = begin; face != end; ++face) {
    work.faces[work.ends[face->smallest_and_face >> 2]++] = *face;
  }
  Tally tally;
  std::uint32_t first = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    const Tally one =
        link_bucket(work.faces.data() + first, work.faces.data() + work.ends[v], adjacency);
    tally.boundary += one.boundary;
    tally.crowded += one.crowded;
    first = work.ends[v];
  }
  return tally;
}

bool same_vertices(Cell a, Cell b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  return a == b;
}

// Parts the cells that are linked to a double of theirs, and counts the faces. Of doubles all four
// faces are the same triangles: either these have no third cell and the two are linked four times,
// or one of them is crowded.
std::size_t part_doubles(const TetMesh& mesh, Adjacency& adjacency) {
  const bool any_crowded = adjacency.crowded_faces > 0;
  constexpr std::size_t kGrain = 4096;
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, mesh.cells.size(), kGrain), std::size_t{0},
      [&](const tbb::blocked_range<std::size_t>& range, std::size_t parted) {
        for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
          std::array<std::uint32_t, 4>& neighbors = adjacency.neighbors[cell];
          if (!any_crowded && !(neighbors[0] == neighbors[1] && neighbors[0] == neighbors[2])) {
            continue;
          }
          for (std::uint32_t& neighbor : neighbors) {
            if (neighbor == kNoCell || !same_vertices(mesh.cells[cell], mesh.cells[neighbor])) {
              continue;
            }
            parted += cell < neighbor ? 1 : 0;
            neighbor = kNoCell;  // the double sees to its own side
          }
        }
        return parted;
      },
      std::plus<>());
}

}  // namespace

Adjacency face_adjacency(const TetMesh& mesh) {
  Adjacency adjacency;
  adjacency.neighbors.assign(mesh.cells.size(), {kNoCell, kNoCell, kNoCell, kNoCell});
  const Layout layout(mesh);
  const Partitioned partitioned = partition_faces(mesh, layout);
  std::vector<Tally> tallies(layout.partitions);
  tbb::enumerable_thread_specific<Workspace> workspaces;
  tbb::parallel_for(std::size_t{0}, layout.partitions, [&](std::size_t partition) {
    const Face* faces = partitioned.faces.get();
    tallies[partition] = link_partition(faces + partitioned.begins[partition],
                                        faces + partitioned.begins[partition + 1], layout,
                                        workspaces.local(), adjacency);
  });
  for (const Tally& tally : tallies) {
    adjacency.boundary_faces += tally.boundary;
    adjacency.crowded_faces += tally.crowded;
  }
  adjacency.crowded_faces += part_doubles(mesh, adjacency);
  return adjacency;
}

}  // namespace tetraglass::mesh
