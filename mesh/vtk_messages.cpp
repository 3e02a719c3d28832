#include "mesh/vtk_messages.h"

#include <mutex>

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include "base/errors.h"

namespace tetraglass::mesh {
namespace {

/// The message in one line, without "ERROR: In FILE, line N" and "vtkClass (0x55...): " before it.
std::string essence(const char* text) {
  std::string line(text);
  if (line.rfind("ERROR: In", 0) == 0 || line.rfind("Warning: In", 0) == 0 ||
      line.rfind("Generic Warning: In", 0) == 0) {
    const std::size_t end = line.find('\n');
    line.erase(0, end == std::string::npos ? line.size() : end + 1);
  }
  const std::size_t address = line.find(" (0x");
  const std::size_t end = line.find("): ");
  if (address != std::string::npos && end != std::string::npos && address < end) {
    line.erase(0, end + 3);
  }
  // Damaged files are quoted: what cannot be printed becomes a dot, and a line is enough.
  for (char& c : line) {
    if (c == '\n' || c == '\t') c = ' ';
    if (c < ' ' || c > '~') c = '.';
  }
  constexpr std::size_t kLongest = 200;
  if (line.size() > kLongest) line = line.substr(0, kLongest) + "...";
  const std::size_t last = line.find_last_not_of(' ');
  line.erase(last == std::string::npos ? 0 : last + 1);
  return line;
}

class CatchingWindow : public vtkOutputWindow {
 public:
  static CatchingWindow* New();
  vtkTypeMacro(CatchingWindow, vtkOutputWindow)

      // VTK's names.  NOLINTBEGIN(readability-identifier-naming)
      void DisplayText(const char* /*text*/) override {}
  void DisplayDebugText(const char* /*text*/) override {}
  void DisplayErrorText(const char* text) override { errors.push_back(essence(text)); }
  void DisplayWarningText(const char* text) override { warnings.push_back(essence(text)); }
  void DisplayGenericWarningText(const char* text) override { warnings.push_back(essence(text)); }
  // NOLINTEND(readability-identifier-naming)

  std::vector<std::string> errors;
  std::vector<std::string> warnings;
};
vtkStandardNewMacro(CatchingWindow)

    // VTK has one output window for all threads.
    std::mutex catching;
vtkSmartPointer<vtkOutputWindow> before;
vtkSmartPointer<CatchingWindow> current;
vtkLogger::Verbosity verbosity_before = vtkLogger::VERBOSITY_WARNING;

}  // namespace

VtkMessages::VtkMessages() {
  catching.lock();
  before = vtkOutputWindow::GetInstance();
  current = vtkSmartPointer<CatchingWindow>::New();
  vtkOutputWindow::SetInstance(current);
  // Beside the window, messages go to VTK's log, which is written to stderr.
  verbosity_before = vtkLogger::GetCurrentVerbosityCutoff();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkLogger::SetStderrVerbosity(verbosity_before);
  vtkOutputWindow::SetInstance(before);
  before = nullptr;
  current = nullptr;
  catching.unlock();
}

const std::vector<std::string>& VtkMessages::errors() const {
  return current->errors;
}
const std::vector<std::string>& VtkMessages::warnings() const {
  return current->warnings;
}

void VtkMessages::refuse_damage(const std::string& file) const {
  if (errors().empty()) return;
  throw base::ReadError(file, "is damaged or not complete: " + errors().front());
}

}  // namespace tetraglass::mesh
