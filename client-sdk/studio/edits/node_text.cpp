#include "client-sdk/studio/edits/node_text.hpp"

#include <cmath>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"

namespace mechane::studio {

std::string in_words(double number) {
  return fmt::format("{:.7g}", std::abs(number) < 1e-9 ? 0.0 : number);
}

std::string in_words(const Vec3& p) {
  return fmt::format("{} {} {}", in_words(p.x()), in_words(p.y()), in_words(p.z()));
}

std::string in_words(const Quat& R) {
  const Eigen::AngleAxisd turn(R);
  if (turn.angle() < 1e-9) return "0 0 1 0";
  return in_words(Vec3(turn.axis())) + " " + in_words(turn.angle());
}

std::string with_margin(std::string_view text, const std::string& margin) {
  const std::string line = margin.empty() ? "\n" : margin;
  std::string out = line;
  for (const char c : text)
    out += c == '\n' ? line : std::string(1, c);
  return out;
}

tl::unexpected<Error> no_such_node(const x3d::Document& document, const std::string& def, std::string_view type) {
  return fail(ErrorCode::unknown_name,
              fmt::format("no {} has the DEF '{}'", type.empty() ? "element" : std::string(type), def), def,
              suggest(def, document.defs(type), "there is none"));
}

}  // namespace mechane::studio
