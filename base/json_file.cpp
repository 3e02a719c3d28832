#include "base/json_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/suggest.h"

namespace tetraglass::base {
namespace {

using Json = nlohmann::json;

std::string content(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in.is_open()) throw ReadError(file, "cannot be read");
  try {
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  } catch (const std::ios_base::failure&) {  // a folder opens, and fails only here
    throw ReadError(file, "cannot be read");
  }
}

Json parse(const std::string& file) {
  const std::string text = content(file);
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const std::string what = error.what();
    const std::size_t bracket = what.find("] ");
    throw ReadError(file,
                    fmt::format("is not JSON: {}",
                                bracket == std::string::npos ? what : what.substr(bracket + 2)));
  }
}

}  // namespace

struct JsonValue::Node {
  std::string file;
  std::string place;  // empty: the file
  std::shared_ptr<const Json> document;
  const Json* json;
};

JsonValue::JsonValue(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

JsonValue JsonValue::read(const std::string& file) {
  const auto document = std::make_shared<const Json>(parse(file));
  return JsonValue(std::make_shared<const Node>(Node{file, "", document, document.get()}));
}

JsonValue JsonValue::inside(const void* json, const std::string& place) const {
  return JsonValue(std::make_shared<const Node>(
      Node{node_->file, place, node_->document, static_cast<const Json*>(json)}));
}

std::string JsonValue::name() const {
  return node_->place.empty() ? "the file" : node_->place;
}

void JsonValue::fail(const std::string& what) const {
  throw ReadError(node_->file, name() + " " + what);
}

void JsonValue::require_object() const {
  if (!node_->json->is_object())
    fail(fmt::format("must be an object, not {}", node_->json->type_name()));
}

std::optional<JsonValue> JsonValue::find(const std::string& key) const {
  require_object();
  const auto found = node_->json->find(key);
  if (found == node_->json->end()) return std::nullopt;
  return inside(&*found, node_->place.empty() ? key : node_->place + "." + key);
}

JsonValue JsonValue::member(const std::string& key) const {
  const std::optional<JsonValue> found = find(key);
  if (!found) fail(fmt::format("lacks '{}'", key));
  return *found;
}

void JsonValue::allow_only(const std::vector<std::string>& keys) const {
  require_object();
  for (const auto& [key, value] : node_->json->items()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      fail(fmt::format("has an unknown key '{}'{}", key, suggestion(key, keys)));
  }
}

std::vector<JsonValue> JsonValue::list(const std::string& what) const {
  if (!node_->json->is_array())
    fail(fmt::format("must be a list of {}, not {}", what, node_->json->type_name()));
  std::vector<JsonValue> result;
  for (std::size_t i = 0; i < node_->json->size(); ++i) {
    result.push_back(inside(&(*node_->json)[i], fmt::format("{}[{}]", node_->place, i)));
  }
  return result;
}

std::vector<double> JsonValue::numbers(std::size_t count, const std::string& what) const {
  if (!node_->json->is_array() || node_->json->size() != count)
    fail(fmt::format("must be a list of {}", what));
  std::vector<double> result;
  for (const JsonValue& element : list("numbers")) result.push_back(element.number());
  return result;
}

std::optional<std::vector<JsonValue>> JsonValue::elements() const {
  if (!node_->json->is_array()) return std::nullopt;
  return list("a list");
}

std::string JsonValue::word() const {
  if (node_->json->is_string()) return node_->json->get<std::string>();
  if (node_->json->is_number() || node_->json->is_boolean()) return node_->json->dump();
  fail(fmt::format("must be a text, a number, true or false, not {}", node_->json->dump()));
}

double JsonValue::number() const {
  if (!node_->json->is_number())
    fail(fmt::format("must be a number, not {}", node_->json->type_name()));
  return node_->json->get<double>();
}

std::string JsonValue::text() const {
  if (!node_->json->is_string())
    fail(fmt::format("must be a string, not {}", node_->json->type_name()));
  return node_->json->get<std::string>();
}

}  // namespace tetraglass::base
