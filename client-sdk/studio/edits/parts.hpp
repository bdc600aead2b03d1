// The library: parts that are inserted into a draft, and the exhibits that a draft can begin as. All are made of X3D's own shapes.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/state/description.hpp"

namespace mechane::studio {

/// A collidable of a part. The words are X3D's.
struct PartShape {
  std::string_view suffix;    ///< of its DEF, after the body's
  std::string_view place;     ///< attributes that place it on the body, each after a blank
  std::string_view colour;    ///< diffuseColor
  std::string_view geometry;  ///< empty: there is no such shape
};

/// A RigidBody with its shapes.
struct Part {
  std::string_view name;
  std::string_view def;  ///< what it is called where nobody says otherwise
  std::string_view title_el;
  std::string_view title_en;
  std::string_view body;    ///< its attributes, but for name and place
  std::string_view effort;  ///< effortScale of what a hand can take; empty: a hand cannot take it
  std::array<PartShape, 2> shapes;
  int teeth = 0;  ///< of a spur gear; its first shape is drawn with so many. 0: the part is not a gear
};

[[nodiscard]] std::span<const Part> parts();
/// Null where the library has none of that name.
[[nodiscard]] const Part* find_part(std::string_view name);
[[nodiscard]] std::vector<std::string> part_names();
/// A part as XML, with this DEF and place in W.
[[nodiscard]] std::string text_of(const Part& part, std::string_view def, std::string_view position);

/// A whole exhibit with a visit, from templates/NAME.x3d: $ID stands for its id.
struct Template {
  std::string_view name;
  std::string_view title_el;
  std::string_view title_en;
};

[[nodiscard]] std::span<const Template> templates();
[[nodiscard]] const Template* find_template(std::string_view name);
/// Its text, as an exhibit of that id.
[[nodiscard]] std::string text_of(const Template& a_template, std::string_view id);

}  // namespace mechane::studio
