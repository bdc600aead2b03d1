#include "client-sdk/gateway/browsers/browser_text.hpp"

#include <nlohmann/json.hpp>

#include "client-sdk/gateway/browsers/browser_message.hpp"
#include "client-sdk/gateway/browsers/vector_json.hpp"

namespace mechane::gateway {
namespace {

using TextJson = nlohmann::json;

std::string written(const TextJson& json) {
  return json.dump(-1, ' ', false, TextJson::error_handler_t::replace);
}

TextJson pose_json(const Pose& X) {
  return {X.p.x(), X.p.y(), X.p.z(), X.R.x(), X.R.y(), X.R.z(), X.R.w()};
}

TextJson texts_json(const client::Texts& texts) {
  TextJson out = TextJson::object();
  for (const auto& [language, text] : texts)
    out[language] = text;
  return out;
}

TextJson button_json(const picture::OverlayButton& button) {
  return {{"action", action_text(button.action)}, {"text", button.text}};
}

std::string_view word_of(client::Affordance::Kind kind) {
  using Kind = client::Affordance::Kind;
  if (kind == Kind::taken) return "taken";
  if (kind == Kind::turns) return "turns";
  if (kind == Kind::slides) return "slides";
  return kind == Kind::placed ? "placed" : "brought";
}

std::string_view word_of(picture::OverlayNotice::Sign sign) {
  using Sign = picture::OverlayNotice::Sign;
  if (sign == Sign::take) return "take";
  if (sign == Sign::wear) return "wear";
  if (sign == Sign::target) return "target";
  if (sign == Sign::warm) return "warm";
  return sign == Sign::unplugged ? "unplugged" : "wait";
}

TextJson quantity_json(const client::QuantityInfo& quantity) {
  TextJson out{{"name", quantity.name}, {"unit", quantity.unit}, {"label", texts_json(quantity.label)}};
  if (quantity.range) out["range"] = {{"least", quantity.range->least}, {"greatest", quantity.range->greatest}};
  if (quantity.goal) out["goal"] = {{"value", quantity.goal->value}, {"fromAbove", quantity.goal->from_above}};
  return out;
}

TextJson effect_json(const client::Effect& effect) {
  TextJson out{{"name", effect.name},
               {"kind", effect.kind},
               {"node", effect.node},
               {"p", vector_json(effect.p_BE)},
               {"direction", vector_json(effect.direction_B)},
               {"quantity", effect.quantity},
               {"full", effect.full},
               {"size", effect.size_m},
               {"speed", effect.speed_m_per_s}};
  if (effect.object) out["object"] = *effect.object;
  return out;
}

TextJson affordance_json(const client::Affordance& affordance) {
  TextJson out{{"kind", word_of(affordance.kind)},
               {"agent", affordance.agent},
               {"object", affordance.object},
               {"AJ", pose_json(affordance.X_AJ)},
               {"BJ", pose_json(affordance.X_BJ)}};
  if (affordance.base) out["base"] = *affordance.base;
  return out;
}

TextJson panel_json(const picture::OverlayPanel& panel) {
  TextJson answers = TextJson::array();
  for (const picture::OverlayButton& answer : panel.answers)
    answers.push_back(button_json(answer));
  return {{"title", panel.title},
          {"goal", panel.goal},
          {"text", panel.text},
          {"more", panel.more},
          {"answers", answers},
          {"scale", panel.scale},
          {"low", panel.low},
          {"high", panel.high},
          {"leave", panel.leave ? button_json(*panel.leave) : TextJson()},
          {"asked", panel.asked},
          {"questions", panel.questions}};
}

TextJson pose_panel_json(const picture::OverlayPose& pose) {
  TextJson drawing = TextJson::array();
  for (const picture::HandStroke& stroke : pose.drawing)
    drawing.push_back({{"from", {stroke.from.x(), stroke.from.y()}},
                       {"to", {stroke.to.x(), stroke.to.y()}},
                       {"radius", stroke.radius},
                       {"part", stroke.part}});
  return {{"text", pose.text}, {"more", pose.more},   {"again", pose.again}, {"held", pose.held},
          {"done", pose.done}, {"total", pose.total}, {"drawing", drawing}};
}

TextJson gauges_json(const std::vector<picture::Readout>& readouts) {
  TextJson out = TextJson::array();
  for (const picture::Readout& readout : readouts) {
    TextJson gauge{{"label", readout.label},       {"value", readout.value}, {"unit", readout.unit},
                   {"fraction", readout.fraction}, {"begin", readout.begin}, {"end", readout.end}};
    if (readout.goal) gauge["goal"] = *readout.goal;
    out.push_back(std::move(gauge));
  }
  return out;
}

}  // namespace

std::string hello_text(const std::string& kiosk, const std::string& display, const HandFinders& finders) {
  return written({{"type", "hello"},
                  {"protocol", kStreamVersion},
                  {"gateway", MECHANE_VERSION},
                  {"kiosk", kiosk},
                  {"display", display},
                  {"mayPoint", true},
                  {"cameraHand", {{"model", finders.model}, {"program", finders.program}}}});
}

std::string link_text(client::LinkState state, const std::string& refusal) {
  return written({{"type", "link"}, {"state", client::link_name(state)}, {"refusal", refusal}});
}

std::string world_text(const client::WorldStatus& status) {
  TextJson quantities = TextJson::array();
  for (const client::QuantityInfo& quantity : status.quantities)
    quantities.push_back(quantity_json(quantity));
  return written({{"type", "world"},
                  {"world", status.world},
                  {"scenario", status.scenario},
                  {"activity", status.activity},
                  {"step", status.step},
                  {"stepsDone", status.steps_done},
                  {"stepsTotal", status.steps_total},
                  {"done", status.done},
                  {"hint", status.hint},
                  {"agents", status.enabled_agents},
                  {"quantities", quantities},
                  {"title", texts_json(status.title)},
                  {"caption", texts_json(status.caption)},
                  {"hintText", texts_json(status.hint_text)},
                  {"activities", status.activities},
                  {"narration", texts_json(status.narration)},
                  {"audio", texts_json(status.audio)},
                  {"detail", status.detail}});
}

std::string scene_text(std::span<const client::SceneObject> objects) {
  TextJson list = TextJson::array();
  for (const client::SceneObject& object : objects)
    list.push_back({{"index", object.index},
                    {"name", object.name},
                    {"uri", object.mesh_uri},
                    {"hash", object.mesh_hash},
                    {"node", object.mesh_node},
                    {"parent", object.parent},
                    {"pose", pose_json(object.X_WB)},
                    {"movable", object.movable},
                    {"title", texts_json(object.title)}});
  return written({{"type", "scene"}, {"objects", list}});
}

std::string presentation_text(const client::WorldPresentation& presentation) {
  TextJson activities = TextJson::array(), views = TextJson::array(), effects = TextJson::array(),
           affordances = TextJson::array();
  for (const client::Activity& activity : presentation.activities)
    activities.push_back(
        {{"name", activity.name}, {"title", texts_json(activity.title)}, {"goal", texts_json(activity.goal)}});
  for (const client::View& view : presentation.views)
    views.push_back({{"name", view.name}, {"pose", pose_json(view.X_WV)}, {"fov", view.field_of_view_rad}});
  for (const client::Effect& effect : presentation.effects)
    effects.push_back(effect_json(effect));
  for (const client::Affordance& affordance : presentation.affordances)
    affordances.push_back(affordance_json(affordance));
  return written({{"type", "presentation"},
                  {"world", presentation.world},
                  {"languages", presentation.languages},
                  {"activities", activities},
                  {"views", views},
                  {"effects", effects},
                  {"affordances", affordances}});
}

std::string overlay_text(const BrowserWords& words) {
  const picture::OverlayContent& content = words.content;
  TextJson buttons = TextJson::array();
  for (const picture::OverlayButton& button : content.corner)
    buttons.push_back(button_json(button));
  TextJson notice;
  if (content.notice)
    notice = {{"sign", word_of(content.notice->sign)}, {"text", content.notice->text}, {"more", content.notice->more}};
  return written({{"type", "overlay"},
                  {"language", words.language},
                  {"languages", words.languages},
                  {"title", content.title},
                  {"caption", content.caption},
                  {"subtitle", words.subtitle},
                  {"hint", content.hint},
                  {"note", content.note},
                  {"message", content.message},
                  {"goal", content.goal},
                  {"notice", notice},
                  {"steps", {{"done", content.steps_done}, {"total", content.steps_total}}},
                  {"gauges", gauges_json(content.readouts)},
                  {"buttons", buttons},
                  {"panel", content.panel ? panel_json(*content.panel) : TextJson()},
                  {"pose", content.pose ? pose_panel_json(*content.pose) : TextJson()},
                  {"largeText", content.style.text_scale > 1},
                  {"highContrast", content.style.high_contrast}});
}

namespace {

TextJson hand_json(const HandTold& hand) {
  using View = pointer::PointerView;
  constexpr std::array<std::string_view, 4> kPhases{"resting", "reaching", "holding", "leaving"};
  constexpr std::array<std::string_view, 3> kDrags{"carry", "turn", "slide"};
  const View& view = hand.view;
  TextJson out{{"phase", kPhases[static_cast<std::size_t>(view.phase)]},
               {"drag", kDrags[static_cast<std::size_t>(view.drag)]},
               {"object", view.object},
               {"p", vector_json(view.p_WH)},
               {"radius", view.radius_m},
               {"link", link_word(hand.link)}};
  if (view.p_WG) out["goal"] = vector_json(*view.p_WG);
  if (view.phase == View::Phase::holding && view.drag == View::Drag::turn)
    out["axle"] = {{"p", vector_json(view.axle.p_W)}, {"d", vector_json(view.axle.a_W)}};
  return out;
}

}  // namespace

std::string_view link_word(pointer::PointerLinkState link) {
  constexpr std::array<std::string_view, 4> kLinks{"none", "waiting", "joined", "refused"};
  return kLinks.at(static_cast<std::size_t>(link));
}

std::string pointer_text(std::span<const HandTold> hands) {
  TextJson out = hand_json(hands.front());
  out["type"] = "pointer";
  for (const HandTold& other : hands.subspan(1))
    out["others"].push_back(hand_json(other));
  return written(out);
}

std::string event_text(const client::WorldEvent& event) {
  return written({{"type", "event"},
                  {"tick", event.tick},
                  {"kind", event.kind},
                  {"subject", event.subject},
                  {"object", event.object},
                  {"value", event.value}});
}

std::string settings_text(const client::DisplaySettings& settings) {
  return written(
      {{"type", "settings"}, {"volume", settings.volume}, {"mute", settings.silent()}, {"quality", settings.quality}});
}

std::string bye_text(const std::string& reason, const std::string& remedy) {
  return written({{"type", "bye"}, {"reason", reason}, {"remedy", remedy}});
}

}  // namespace mechane::gateway
