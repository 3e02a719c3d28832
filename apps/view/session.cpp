#include "apps/view/session.h"

#include <array>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/json_file.h"
#include "base/output_file.h"

namespace tetraglass::apps::view {
namespace {

nlohmann::ordered_json vector_json(const Eigen::Vector3d& vector) {
  return std::array{vector.x(), vector.y(), vector.z()};
}

}  // namespace

void write_session(const Session& session, const std::string& file) {
  nlohmann::ordered_json camera = {{"eye", vector_json(session.camera.eye)},
                                   {"target", vector_json(session.camera.target)},
                                   {"up", vector_json(session.camera.up)}};
  if (session.camera.parallel) {
    camera["ortho"] = session.camera.ortho_height;
  } else {
    camera["fov"] = session.camera.fov_degrees;
  }
  const nlohmann::ordered_json json = {{"words", session.words}, {"camera", camera}};
  base::OutputFile output(file);
  output.write(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  output.commit();
}

bool is_session_name(const std::string& file) {
  return file.ends_with(".session.json");
}

std::vector<std::string> read_session_words(const std::string& file) {
  std::vector<std::string> words;
  const base::JsonValue json = base::JsonValue::read(file);
  for (const base::JsonValue& word : json.member("words").list("a list of words")) {
    words.push_back(word.text());
  }
  if (words.empty() || words.front() != "render") {
    json.member("words").fail("must be those of a command line of render");
  }
  words.erase(words.begin());
  return words;
}

}  // namespace tetraglass::apps::view
