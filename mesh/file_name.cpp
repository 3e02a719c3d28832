#include "mesh/file_name.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "base/errors.h"

namespace tetraglass::mesh {

std::string extension_of(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string content_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  std::string content;
  if (stream) {
    content.resize(static_cast<std::size_t>(std::max<std::streamoff>(stream.tellg(), 0)));
    stream.seekg(0);
    stream.read(content.data(), static_cast<std::streamsize>(content.size()));
  }
  if (!stream) throw base::ReadError(file, "cannot be read");
  return content;
}

}  // namespace tetraglass::mesh
