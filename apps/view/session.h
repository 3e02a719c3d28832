#pragma once

#include <string>
#include <vector>

#include "project/camera.h"

namespace tetraglass::apps::view {

/// What the window shows, for another time.
struct Session {
  std::vector<std::string> words;  ///< of its picture's command line, as `render_words` makes them
  project::Camera camera;
};

/// Writes it as JSON: {"words": [...], "camera": {...}}, which render --camera reads too. Throws
/// WriteError.
void write_session(const Session& session, const std::string& file);

/// Whether a file is to be read as a session, by its name: *.session.json.
[[nodiscard]] bool is_session_name(const std::string& file);

/// The words of a session. Throws ReadError.
[[nodiscard]] std::vector<std::string> read_session_words(const std::string& file);

}  // namespace tetraglass::apps::view
