#pragma once

#include "preint/table.h"

namespace tetraglass::preint {

/// Light of segments of one length, parted by a ramp towards the front and one towards the back
/// (lum2004, "Interpolated Pre-Integrated Lighting"), packed as in its section "Optimizing Texture
/// Lookups". With lighting at both ends of the segment, the picture is
/// diffuse_front front.rgb + diffuse_back back.rgb + specular_front (front.a - back.a)
/// + specular_back back.a, with the opacity front.a. front.rgb + back.rgb is the unlit light.
struct RampedTables {
  Table2D front;  ///< RGB: front-weighted light; A: opacity
  Table2D back;   ///< RGB: back-weighted light; A: back-weighted light of a white medium
};

/// Errors: throws UsageError like `slab_table`, whose accuracy it has.
[[nodiscard]] RampedTables ramped_tables(const TransferFunction& tf, double low, double high,
                                         double length, int n,
                                         TableMethod method = TableMethod::incremental);

/// The same for m lengths from 0 to `max_length`, as in `full_table`.
struct RampedTables3D {
  Table3D front;
  Table3D back;
};
[[nodiscard]] RampedTables3D ramped_tables_3d(const TransferFunction& tf, double low, double high,
                                              double max_length, int n, int m,
                                              TableMethod method = TableMethod::incremental,
                                              LengthAxis axis = LengthAxis::linear);

/// Averages over segments of one length, weighted by how visible each place is from the front
/// (meissner2002 section 4; the print of its Eqs. 3, 5 and 6 lacks the opacity of the contributing
/// sample and the normalization): int f kappa exp(-tau) dl / int kappa exp(-tau) dl. RGB: ambient,
/// diffuse and specular coefficient of the material; A: the weight of the gradient at the back (0
/// to 1, the mean position; the front has the rest). Where the segment is fully transparent,
/// nothing is seen: the coefficients are the means of both ends, the weight 1/2.
[[nodiscard]] Table2D material_table(const TransferFunction& tf, double low, double high,
                                     double length, int n,
                                     TableMethod method = TableMethod::incremental);

/// The same for m lengths from 0 to `max_length`, as in `full_table`; the entries of length 0 are
/// the limit for short segments.
[[nodiscard]] Table3D material_table_3d(const TransferFunction& tf, double low, double high,
                                        double max_length, int n, int m,
                                        TableMethod method = TableMethod::incremental,
                                        LengthAxis axis = LengthAxis::linear);

}  // namespace tetraglass::preint
