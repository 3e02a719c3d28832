#pragma once

#include <string>
#include <vector>

namespace tetraglass::mesh {

/// Catches what VTK would print on stderr, from its construction to its destruction: VTK tells of a
/// damaged file by a printed line and hands over what it has got so far. One catcher at a time in a
/// process; a second one, in another thread, waits.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// So far, without VTK's source line and object address; each on one line.
  [[nodiscard]] const std::vector<std::string>& errors() const;
  [[nodiscard]] const std::vector<std::string>& warnings() const;

  /// Throws ReadError with the first error, if there is one.
  void refuse_damage(const std::string& file) const;
};

}  // namespace tetraglass::mesh
