// JSON from anywhere, read field by field. For the .cpp files of this room only.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "server/base/error.hpp"

namespace mechane::studio {

/// A discarded value where the text is not JSON, or is nested deeper than `deepest`.
[[nodiscard]] inline nlohmann::json parse_shallow(std::string_view text, int deepest) {
  bool too_deep = false;
  const auto watch = [&too_deep, deepest](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  nlohmann::json json = nlohmann::json::parse(text, watch, false);
  return too_deep ? nlohmann::json(nlohmann::json::value_t::discarded) : json;
}

/// One object. After the first wrong field, fault() says which it was. The object must outlive it.
class RequestFields {
 public:
  RequestFields(const nlohmann::json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object_.is_object()) blame("", "an object {...}");
  }
  [[nodiscard]] bool has(const char* name) const { return object_.is_object() && object_.contains(name); }
  [[nodiscard]] const nlohmann::json* find(const char* name) const { return has(name) ? &object_[name] : nullptr; }
  void blame(std::string_view field, std::string_view what) {
    if (!fault_.empty()) return;
    where_ += where_.empty() || field.empty() ? "" : "/";
    where_ += field;
    fault_ = what;
  }
  [[nodiscard]] bool right() const { return fault_.empty(); }
  [[nodiscard]] tl::unexpected<Error> fault() const {
    return fail(ErrorCode::invalid_value, "this request is not as it should be", where_, "write " + fault_);
  }
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  const nlohmann::json& object_;
  std::string where_;
  std::string fault_;
};

}  // namespace mechane::studio
