#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/suggest.h"
#include "preint/transfer_function.h"

namespace tetraglass::preint {
namespace {

using Json = nlohmann::json;

/// Reads one file; every complaint names the file and the place in it.
class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  TransferFunction read() const {
    const Json root = parse();
    require_object(root, "the file");
    check_keys(root, "the file", {"points"});
    const Json& list = required(root, "the file", "points");
    if (!list.is_array()) fail("'points' must be a list of points, not {}", list.type_name());
    std::vector<ControlPoint> points;
    for (std::size_t i = 0; i < list.size(); ++i) {
      points.push_back(point(list[i], fmt::format("points[{}]", i)));
    }
    try {
      return TransferFunction(std::move(points));
    } catch (const base::InputError& error) {
      throw base::ReadError(file_, error.what());
    }
  }

 private:
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw base::ReadError(file_, fmt::format(format, std::forward<Args>(args)...));
  }

  std::string content() const {
    std::ifstream in(file_, std::ios::binary);
    if (!in.is_open()) fail("cannot be read");
    try {
      return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    } catch (const std::ios_base::failure&) {  // a folder opens, and fails only here
      fail("cannot be read");
    }
  }

  Json parse() const {
    const std::string text = content();
    try {
      return Json::parse(text);
    } catch (const Json::exception& error) {
      // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
      const std::string what = error.what();
      const std::size_t bracket = what.find("] ");
      fail("is not JSON: {}", bracket == std::string::npos ? what : what.substr(bracket + 2));
    }
  }

  void require_object(const Json& json, const std::string& where) const {
    if (!json.is_object()) fail("{} must be an object, not {}", where, json.type_name());
  }

  void check_keys(const Json& object, const std::string& where,
                  const std::vector<std::string>& known) const {
    for (const auto& [key, value] : object.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        fail("{} has an unknown key '{}'{}", where, key, base::suggestion(key, known));
      }
    }
  }

  const Json& required(const Json& object, const std::string& where, const std::string& key) const {
    const auto found = object.find(key);
    if (found == object.end()) fail("{} lacks '{}'", where, key);
    return *found;
  }

  double number(const Json& json, const std::string& where) const {
    if (!json.is_number()) fail("{} must be a number, not {}", where, json.type_name());
    return json.get<double>();
  }

  ControlPoint point(const Json& json, const std::string& where) const {
    static const std::vector<std::string> kKnown = {"value",   "color",    "extinction", "ambient",
                                                    "diffuse", "specular", "shininess"};
    require_object(json, where);
    check_keys(json, where, kKnown);
    ControlPoint result;
    result.value = number(required(json, where, "value"), where + ".value");
    result.extinction = number(required(json, where, "extinction"), where + ".extinction");
    const Json& color = required(json, where, "color");
    if (!color.is_array() || color.size() != 3) {
      fail("{}.color must be a list of three numbers: red, green, blue", where);
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
      result.color[static_cast<long>(channel)] =
          number(color[channel], fmt::format("{}.color[{}]", where, channel));
    }
    const auto optional = [&](const char* key, double& coefficient) {
      const auto found = json.find(key);
      if (found != json.end()) coefficient = number(*found, fmt::format("{}.{}", where, key));
    };
    optional("ambient", result.material.ambient);
    optional("diffuse", result.material.diffuse);
    optional("specular", result.material.specular);
    optional("shininess", result.material.shininess);
    return result;
  }

  const std::string& file_;
};

}  // namespace

TransferFunction read_transfer_function(const std::string& file) {
  return Reader(file).read();
}

}  // namespace tetraglass::preint
