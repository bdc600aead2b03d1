#include "client-sdk/studio/edits/joint_edits.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "client-sdk/authoring/text_edits.hpp"
#include "client-sdk/studio/edits/node_text.hpp"
#include "server/x3d/node_fields.hpp"

namespace mechane::studio {
namespace {

using authoring::escape_attribute;
using authoring::TextEdits;
using x3d::Document;
using x3d::NodeId;

struct JointWords {
  std::string_view node;
  std::string_view agent;  ///< that switches it on
  std::string_view def;    ///< what it is called where nobody says otherwise
};
/// In the order of state::JointKind.
constexpr std::array<JointWords, 3> kJointWords{{{"SingleAxisHingeJoint", "geometry.hinge", "HINGE"},
                                                 {"SliderJoint", "geometry.slider", "SLIDER"},
                                                 {"BallJoint", "geometry.ball", "BALL_JOINT"}}};

struct Joined {
  NodeId body1, body2;  ///< the first stands; none: the room
};

Expected<NodeId> body_called(const Document& document, const std::string& def) {
  const NodeId body = document.find_def(def);
  if (!body || document[body].name != "RigidBody") return no_such_node(document, def, "RigidBody");
  return body;
}

Expected<Joined> bodies_of(const Document& document, const JoinBodies& join) {
  const auto body1 = body_called(document, join.body1);
  if (!body1) return tl::unexpected(body1.error());
  const bool room = join.body2.empty();
  const auto body2 = room ? NodeId() : body_called(document, join.body2);
  if (!body2) return tl::unexpected(body2.error());
  if (*body1 == *body2)
    return fail(ErrorCode::conflict, fmt::format("{} cannot be joined to itself", join.body1), join.body1,
                "name another body, or only one to join it to the room");
  const auto is_fixed = [&](NodeId body) { return !body || x3d::NodeFields(document, body).boolean("fixed"); };
  const bool stands = is_fixed(*body1);
  if (stands && is_fixed(*body2))
    return fail(ErrorCode::conflict,
                room ? fmt::format("{} is fixed, so no joint can move it", join.body1)
                     : fmt::format("{} and {} are both fixed, so no joint can move them", join.body1, join.body2),
                join.body1, "let one of them move: take its field 'fixed' away");
  return !room && !stands && is_fixed(*body2) ? Joined{*body2, *body1} : Joined{*body1, *body2};
}

/// The first collection that ends after both bodies: a USE stands after its DEF.
NodeId collection_after(const Document& document, const Joined& joined) {
  const auto collections = document.elements("RigidBodyCollection");
  const auto after = [&](NodeId body, NodeId collection) {
    return !body || document[body].span.end <= document[collection].span.end;
  };
  const auto found = std::ranges::find_if(
      collections, [&](NodeId one) { return after(joined.body1, one) && after(joined.body2, one); });
  return found == collections.end() ? NodeId() : *found;
}

std::string text_of(const Document& document, const JoinBodies& join, const Joined& joined, const JointWords& words,
                    const std::string& def) {
  std::string text = fmt::format("<{} DEF='{}'", words.node, def);
  if (join.kind != state::JointKind::slider) text += fmt::format(" anchorPoint='{}'", in_words(join.p_WA));
  if (join.kind != state::JointKind::ball) text += fmt::format(" axis='{}'", in_words(join.axis_W));
  text += fmt::format(
      ">\n  <MetadataSet containerField='metadata' name='mechane:agent'>"
      "\n    <MetadataString containerField='value' name='type' value='\"{}\"'/>\n  </MetadataSet>",
      words.agent);
  for (const auto& [field, body] : {std::pair("body1", joined.body1), std::pair("body2", joined.body2)})
    if (body)
      text += fmt::format("\n  <RigidBody containerField='{}' USE='{}'/>", field,
                          escape_attribute(*document[body].attribute("DEF")));
  return text + fmt::format("\n</{}>", words.node);
}

/// The last Viewpoint that stands in the Scene itself, where nothing moves it, if the Scene has one.
NodeId last_view(const Document& document) {
  NodeId last;
  for (const NodeId view : document.elements("Viewpoint"))
    if (document[view].parent == document.scene()) last = view;
  return last;
}

}  // namespace

Expected<Grown> with_joint(const Document& document, const JoinBodies& join) {
  if (!join.name.empty() && !is_new_name(join.name)) return no_new_name(join.name);
  const auto joined = bodies_of(document, join);
  if (!joined) return tl::unexpected(joined.error());
  const NodeId into = collection_after(document, *joined);
  if (!into)
    return fail(ErrorCode::missing, "no RigidBodyCollection follows the bodies that could hold the joint", join.body1,
                "put the bodies into a RigidBodyCollection");
  const JointWords& words = kJointWords.at(static_cast<std::size_t>(join.kind));
  const std::string name = free_name(document, join.name.empty() ? std::string(words.def) : join.name);
  const std::string text = text_of(document, join, *joined, words, name);
  TextEdits edits;
  authoring::append_inside(document, into, with_margin(text, authoring::inner_margin_of(document, into)), edits);
  return Grown{edits.apply(document.source()), name};
}

Expected<Grown> with_view(const Document& document, const AddView& view) {
  if (!view.name.empty() && !is_new_name(view.name)) return no_new_name(view.name);
  const std::string name = free_name(document, view.name.empty() ? "VIEW" : view.name);
  std::string text = fmt::format("<Viewpoint DEF='{}'", name);
  if (!view.description.empty()) text += fmt::format(" description='{}'", escape_attribute(view.description));
  text += fmt::format(" position='{}' orientation='{}'", in_words(view.X_WV.p), in_words(view.X_WV.R));
  if (view.field_of_view_rad > 0) text += fmt::format(" fieldOfView='{}'", in_words(view.field_of_view_rad));
  text += "/>";
  TextEdits edits;
  if (const NodeId last = last_view(document)) {
    edits.insert(document[last].span.end, std::string(authoring::margin_of(document, last)) + text);
  } else {
    const NodeId scene = document.scene();
    authoring::append_inside(document, scene, with_margin(text, authoring::inner_margin_of(document, scene)), edits);
  }
  return Grown{edits.apply(document.source()), name};
}

}  // namespace mechane::studio
