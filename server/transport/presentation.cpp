#include "server/transport/presentation.hpp"

#include "server/state/affordances.hpp"
#include "server/state/limits.hpp"
#include "server/transport/wire_texts.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::transport {

static_assert(mechane_kMaxPresented == state::kMaxPresented);
static_assert(mechane_kMaxLanguages == state::kMaxLanguages);
static_assert(mechane_kMaxAffordances == state::kMaxAffordances);
static_assert(mechane_affordance_taken == static_cast<int>(state::Affordance::Kind::taken));
static_assert(mechane_affordance_turns == static_cast<int>(state::Affordance::Kind::turns));
static_assert(mechane_affordance_slides == static_cast<int>(state::Affordance::Kind::slides));
static_assert(mechane_affordance_placed == static_cast<int>(state::Affordance::Kind::placed));
static_assert(mechane_affordance_brought == static_cast<int>(state::Affordance::Kind::brought));

template <class Sequence>
void Presentation::set_texts(Sequence& sequence, const state::Texts& texts) {
  proto::look_into(sequence, texts_.emplace_back(wire_texts(texts)));
}

Presentation::Presentation(const std::string& world, const state::WorldDescription& description)
    : languages_(proto::pointers_to(description.languages)) {
  add_activities(description);
  add_views(description);
  add_effects(description);
  add_affordances(description);
  proto::set_text(wire_.world, world);
  wire_.protocol = proto::kProtocol;
  wire_.seq = 1;
  wire_.sent_ns = to_ns(std::chrono::steady_clock::now());
  proto::look_into(wire_.languages, languages_);
  proto::look_into(wire_.activities, activities_);
  proto::look_into(wire_.views, views_);
  proto::look_into(wire_.effects, effects_);
  proto::look_into(wire_.affordances, affordances_);
}

void Presentation::add_activities(const state::WorldDescription& description) {
  for (const state::ActivityDescription& activity : description.activities) {
    std::vector<proto::WireQuestion>& questions = questions_.emplace_back();
    for (const state::QuestionDescription& question : activity.questionnaire)
      questions.push_back(question_of(question));
    proto::WireActivity& wire = activities_.emplace_back();
    wire.name = proto::look_into(activity.name);
    set_texts(wire.title, activity.title);
    set_texts(wire.goal, activity.goal);
    proto::look_into(wire.questions, questions);
  }
}

proto::WireQuestion Presentation::question_of(const state::QuestionDescription& question) {
  std::vector<proto::WireAnswer>& answers = answers_.emplace_back();
  for (const auto& answer : question.answers) {
    proto::WireAnswer& wire = answers.emplace_back();
    wire.name = proto::look_into(answer.name);
    set_texts(wire.text, answer.text);
  }
  proto::WireQuestion wire{};
  wire.name = proto::look_into(question.name);
  wire.kind =
      question.kind == state::QuestionDescription::Kind::scale ? mechane_question_scale : mechane_question_choice;
  wire.marks = static_cast<std::uint32_t>(question.marks);
  set_texts(wire.text, question.question);
  set_texts(wire.low, question.low);
  set_texts(wire.high, question.high);
  proto::look_into(wire.answers, answers);
  return wire;
}

void Presentation::add_views(const state::WorldDescription& description) {
  for (const state::Viewpoint& view : description.viewpoints) {
    proto::WireView& wire = views_.emplace_back();
    wire.name = proto::look_into(view.name);
    proto::set_pose(wire.X_WV, view.X_WV);
    wire.field_of_view_rad = static_cast<float>(view.field_of_view_rad);
  }
}

void Presentation::add_effects(const state::WorldDescription& description) {
  for (const state::EffectDescription& effect : description.effects) {
    if (effect.felt) continue;
    proto::WireEffect& wire = effects_.emplace_back();
    wire.name = proto::look_into(effect.name);
    wire.kind = proto::look_into(effect.kind);
    wire.object = effect.body ? static_cast<std::int32_t>(effect.body.index()) : -1;
    wire.node = proto::look_into(effect.node);
    proto::set_vec3(wire.p_BE, effect.p_BE);
    proto::set_vec3(wire.direction_B, effect.direction_B);
    wire.quantity = static_cast<std::uint32_t>(effect.quantity.index());
    wire.full = static_cast<float>(effect.full);
    wire.size_m = static_cast<float>(effect.size_m);
    wire.speed_m_per_s = static_cast<float>(effect.speed_m_per_s);
  }
}

void Presentation::add_affordances(const state::WorldDescription& description) {
  for (const state::Affordance& affordance : state::affordances_of(description)) {
    proto::WireAffordance& wire = affordances_.emplace_back();
    wire.kind = static_cast<std::uint32_t>(affordance.kind);
    wire.agent = affordance.agent ? proto::look_into(description.agents[affordance.agent.index()].name) : nullptr;
    wire.object = static_cast<std::uint32_t>(affordance.object.index());
    wire.base = affordance.base ? static_cast<std::int32_t>(affordance.base.index()) : -1;
    proto::set_pose(wire.X_AJ, affordance.X_AJ);
    proto::set_pose(wire.X_BJ, affordance.X_BJ);
  }
}

}  // namespace mechane::transport
