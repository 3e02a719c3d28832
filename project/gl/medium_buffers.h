#pragma once

#include "preint/transfer_function.h"
#include "project/gl/normalization.h"
#include "project/gl/objects.h"

namespace tetraglass::project::gl {

/// The transfer function on the context, as medium.glsl reads it: any number of control points.
class MediumBuffers {
 public:
  /// No light tells more from infinity; products of floats of this size stay finite.
  static constexpr double kMostExtinction = 1e20;  ///< per half diagonal of the mesh
  static constexpr double kMostColor = 1e15;

  /// Extinction becomes that per unit of normalized length. Both are bounded as above.
  MediumBuffers(const Context& context, const preint::TransferFunction& tf,
                const Normalization& normalization);

  void bind() const;

  [[nodiscard]] std::size_t bytes() const { return pieces_.bytes() + index_.bytes(); }

 private:
  TextureBuffer pieces_;
  TextureBuffer index_;
};

}  // namespace tetraglass::project::gl
