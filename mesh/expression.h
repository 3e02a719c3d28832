#pragma once

#include <string>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// A point field computed from an expression, one value (or three, if the expression is a vector)
/// per point, e.g. "sqrt(x^2 + y^2) - 0.5 * T" or "mag(V)". Known in it: the coordinates x, y, z;
/// radius (distance from the centre of the bounds); point fields of one or three components by
/// their names, where these are made of letters, digits and '_'; + - * / ^ < > = & |, parentheses,
/// abs acos asin atan ceil cos cosh exp floor ln log10 max min sign sin sinh sqrt tan tanh if(c, a,
/// b), and for vectors mag norm cross . iHat jHat kHat (vtkFunctionParser). A point where it is not
/// defined (1/0, ln(-1)) gets NaN. Throws UsageError for an expression that does not parse, saying
/// where.
[[nodiscard]] Field evaluate_expression(const TetMesh& mesh, const std::string& name,
                                        const std::string& expression);

}  // namespace tetraglass::mesh
