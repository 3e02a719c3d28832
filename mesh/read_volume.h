#pragma once

#include <string>

#include "mesh/mesh_data.h"
#include "mesh/volume.h"

namespace tetraglass::mesh {

/// Reads a regular grid of values, by its extension: NRRD (.nrrd, .nhdr), MetaImage (.mhd, .mha),
/// INRIMAGE-4 (.inr), VolVis (.slc). Values stay as they are; what the file says of their place
/// (origin, spacing, direction of the axes) is kept, in its units. Sizes that are claimed are held
/// against those of the file before anything is allocated. (VTK 9.1 has readers of three of them:
/// those of NRRD and MetaImage leave out directions and packed values, that of .slc writes beyond
/// its arrays where a file is damaged.) Throws ReadError, InputError.
[[nodiscard]] MeshData read_volume(const std::string& file);

/// Reads a file of bare values as a grid of spacing 1. `layout`: "WIDTHxHEIGHTxDEPTH:TYPE[:ENDIAN]"
/// with TYPE int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32 or float64, and
/// ENDIAN little (as usual) or big; the first axis is the fastest. Throws UsageError where the
/// layout is not understood, ReadError where the file is not of that size.
[[nodiscard]] MeshData read_raw(const std::string& file, const std::string& layout);

/// The single formats. Sources: Kindlmann, "Definition of NRRD File Format" (teem.sourceforge.net);
/// MetaIO documentation (Insight Toolkit); INRIMAGE-4 header of INRIA's image library as CGAL
/// documents it; VolVis 2.0 (Avila et al. 1994), "slc" files.
[[nodiscard]] Volume read_nrrd(const std::string& file);
[[nodiscard]] Volume read_metaimage(const std::string& file);
[[nodiscard]] Volume read_inr(const std::string& file);
[[nodiscard]] Volume read_slc(const std::string& file);

}  // namespace tetraglass::mesh
