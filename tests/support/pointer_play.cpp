#include "tests/support/pointer_play.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "client-sdk/client/parse.hpp"
#include "client-sdk/pointer/pointer_exchange.hpp"
#include "client-sdk/pointer/pointer_input.hpp"
#include "server/content/mesh_import.hpp"
#include "server/transport/presentation.hpp"
#include "server/transport/world_port.hpp"

namespace mechane::test {
namespace {

using pointer::PointerEvent;
using pointer::PointerView;
using state::VisitMove;

constexpr picture::PixelSize kPicture{1920, 1080};
constexpr double kPicture_s = transport::WorldPort::kTicksPerFrame * kTickSeconds;  // the person looks as often
constexpr std::uint64_t kTicksPerSample = 2;                                        // as PointerLink sends
constexpr double kNotch = 0.03;         // of the wheel: how much farther it takes a thing, as a share of the distance
constexpr double kPressPatience_s = 4;  // for a hand that reaches
constexpr std::size_t kPresses = 5;     // for one grasp
constexpr int kFetches = 4;             // of what was lost on the way
constexpr double kArrives_s = 8;        // patience with a thing that comes after the finger
constexpr double kNotComing_s = 1.5;    // what has not moved for so long will not come to the finger
constexpr double kMoves_m_per_s = 0.02;
constexpr double kUnderFinger = 0.03;  // share of the picture's height: it has come
constexpr double kDepth_m = 0.015;     // a difference of depth that is seen
constexpr double kAskew_rad = 0.3;     // a rotation that is seen
constexpr double kBlocked_s = 4;       // what has not turned for so long will not
constexpr double kAhead_rad = 0.6;     // how far the finger goes before what turns
constexpr double kStill_s = 0.3;       // before a finger is lifted
constexpr double kTouched_m = 0.03;    // a place this near to a surface is on it
constexpr double kSlipped_m = 0.1;     // what is so far from where it was carried is not there
constexpr double kHome_m = 0.01;       // what is so near to its place is in it

std::vector<client::SceneObject> objects_of(const state::WorldDescription& world) {
  std::vector<client::SceneObject> out;
  for (const state::BodyDescription& body : world.bodies) {
    client::SceneObject& object = out.emplace_back();
    object.index = static_cast<std::uint32_t>(out.size() - 1);
    object.name = body.name;
    object.mesh_uri = body.mesh.uri;
    object.mesh_node = body.mesh.node;
    object.X_WB = body.X_WB;
    object.movable = !body.fixed;
  }
  return out;
}

std::shared_ptr<const client::WorldPresentation> presentation_of(const state::WorldDescription& world) {
  auto out = std::make_shared<client::WorldPresentation>();
  if (!client::parse(transport::Presentation("w1", world).wire(), *out)) throw std::runtime_error("no presentation");
  return out;
}

/// The mesh file's shapes alone: nobody looks at the images.
Expected<content::ImportedScene> import_shapes(const std::filesystem::path& file) {
  auto scene = content::import_mesh(file);
  if (scene) scene->textures.clear();
  return scene;
}

/// The display's own hand, without threads.
class Touch final : public pointer::PointerTouch {
 public:
  explicit Touch(pointer::PointerExchange& hand) : hand_(hand) {}
  void press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched) override {
    hand_.act({pointer::PointerAct::Kind::press, place, 0, sight, touched});
  }
  void move(picture::PixelPlace place) override { hand_.act({pointer::PointerAct::Kind::move, place}); }
  void deepen(double amount) override { hand_.act({pointer::PointerAct::Kind::deepen, {}, amount}); }
  void turn(double angle_rad) override { hand_.act({pointer::PointerAct::Kind::turn, {}, angle_rad}); }
  void release() override { hand_.act({pointer::PointerAct::Kind::release}); }
  [[nodiscard]] PointerView view() override { return hand_.view(); }
  [[nodiscard]] pointer::PointerLinkState state() override { return pointer::PointerLinkState::joined; }

 private:
  pointer::PointerExchange& hand_;
};

/// The way round an axle in the picture.
struct Round {
  picture::PixelPlace middle;
  Eigen::Matrix2d from_circle = Eigen::Matrix2d::Zero();

  [[nodiscard]] picture::PixelPlace at(double angle_rad) const {
    const Eigen::Vector2d way = from_circle * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    return {middle.x + way.x(), middle.y + way.y()};
  }
};

/// Of the circle about an axle; a flat one gets at least this share of its width.
std::optional<Round> round_of(const picture::Sight& sight, const pointer::AffordanceLine& axle, const Vec3& p_WH,
                              double least_round) {
  const Vec3 arm_W = p_WH - axle.p_W;
  const Vec3 middle_W = axle.p_W + arm_W.dot(axle.a_W) * axle.a_W;
  const auto middle = pixel_of(sight, middle_W);
  const auto one = pixel_of(sight, p_WH);
  const auto other = pixel_of(sight, middle_W + axle.a_W.cross(arm_W));
  if (!middle || !one || !other) return {};
  Eigen::Matrix2d seen;
  seen << one->x - middle->x, other->x - middle->x, one->y - middle->y, other->y - middle->y;
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(seen, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector2d half_axes = svd.singularValues();
  half_axes.y() = std::max(half_axes.y(), least_round * half_axes.x());
  return Round{*middle, svd.matrixU() * half_axes.asDiagonal() * svd.matrixV().transpose()};
}

double apart(picture::PixelPlace a, picture::PixelPlace b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

class PointerPerson final : public Person {
 public:
  PointerPerson(ShownExhibit& shown, const state::WorldDescription& description, const state::VisitDescription& visit)
      : shown_(shown),
        description_(description),
        visit_(visit),
        input_(std::make_unique<Touch>(hand_)),
        X_WB_(description.bodies.size()),
        done_rad_(visit.moves.size()) {}

  void act(bool sets_out, state::TickInputs& inputs) override {
    if (sets_out && ticks_ % transport::WorldPort::kTicksPerFrame == 1) live();
    if (click_) {
      inputs.commands[inputs.command_count++] = {++commands_, state::CommandKind::click, *click_};
      click_.reset();
    }
    user_.fresh = false;
    user_.age += kTickPeriod;
    if (ticks_ % kTicksPerSample == 0) move_hand();
    inputs.users[0] = user_;
    ++ticks_;
  }

  void see(const state::WorldState& state) override {
    holding_ = state.users[0].output.holding;
    if (ticks_ % transport::WorldPort::kTicksPerFrame != 1) return;
    frame_.tick = state.tick;
    frame_.bodies.clear();
    frame_.visible.clear();
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
      X_WB_[i] = state.bodies[i].X_WB;
      frame_.visible.push_back(state.bodies[i].visible ? 1 : 0);
      if (!description_.bodies[i].fixed) frame_.bodies.push_back({static_cast<std::uint32_t>(i), X_WB_[i]});
    }
    frame_.quantities = state.quantities;
    status_.enabled_agents.clear();
    for (std::size_t i = 0; i < state.agent_enabled.size(); ++i) {
      if (state.agent_enabled[i] != 0) status_.enabled_agents.push_back(description_.agents[i].name);
    }
  }

  [[nodiscard]] bool finished() const override { return index_ >= visit_.moves.size(); }
  [[nodiscard]] std::span<const visitor::MoveResult> results() const override { return results_; }

 private:
  [[nodiscard]] const VisitMove& move() const { return visit_.moves[index_]; }
  [[nodiscard]] const state::JointDescription& joint() const { return description_.joints[move().joint.index()]; }
  [[nodiscard]] bool resting() { return hand_.view().phase == PointerView::Phase::resting; }
  [[nodiscard]] bool holds() { return hand_.view().phase == PointerView::Phase::holding && holding_; }

  /// What the display's own thread for its hand does, see PointerLink.
  void move_hand() {
    hand_.take_acts();
    if (hand_.resting()) return hand_.publish(pointer::PointerLinkState::joined);
    pointer::PointerHand& hand = hand_.hand();
    const auto senses = pointer::senses_of({&frame_, shown_.objects(), &shown_.presentation(), status_.enabled_agents},
                                           hand.view().object, holding_);
    const auto sample = senses ? hand.advance(kTicksPerSample * kTickSeconds, *senses) : std::nullopt;
    hand_.publish(pointer::PointerLinkState::joined);
    if (!sample) return;
    user_.present = user_.fresh = true;
    user_.age = Duration{0};
    user_.sample = {*sample, 1, user_.sample.sequence + 1, 0};
  }

  /// Between two pictures.
  void live() {
    if (finished()) return;
    if (!std::exchange(begun_, true)) begin();
    time_s_ += kPicture_s;
    if (!go_on()) return;
    const bool again = lost() && fetched_ < kFetches;
    results_.push_back({visitor::name_of(description_, move()), time_s_, ok_ && !again});
    done_rad_[index_] += std::abs(seen_rad_);
    begun_ = false;
    ++index_;
    if (!again) return;
    ++fetched_;
    index_ = last_reach_;
    say(PointerEvent::Kind::release);
  }

  void begin() {
    time_s_ = since_s_ = still_s_ = seen_rad_ = finger_rad_ = gone_rad_ = rolled_ = 0;
    ok_ = true;
    presses_ = 0;
    pressed_ = false;
    from_ = at_;
    const PointerView view = hand_.view();
    if (move().kind == VisitMove::Kind::reach) {
      if (index_ != last_reach_) fetched_ = 0;
      last_reach_ = index_;
      if (!takes()) touch();
    } else if (move().kind == VisitMove::Kind::move_to && holds()) {
      p_WG_goal_ = move().X_WB * (X_WB_[move().body.index()].inverse() * view.p_WH);
      from_depth_m_ = depth_of(sight(), view.p_WH);
      to_ = within(pixel_of(sight(), p_WG_goal_).value_or(at_));
    } else if (move().joint) {
      seen_at_rad_ = swing_from_rad_ = visitor::joint_angle(joint(), X_WB_);
      round_ = holds() ? way_round() : std::nullopt;
    }
  }

  /// True when the move is over.
  bool go_on() {
    switch (move().kind) {
      case VisitMove::Kind::reach:
        return takes() || time_s_ >= move().duration_s;
      case VisitMove::Kind::grasp:
        return take();
      case VisitMove::Kind::move_to:
        return carry();
      case VisitMove::Kind::turn:
      case VisitMove::Kind::swing:
        return work();
      case VisitMove::Kind::release:
        if (!pressed_ && time_s_ >= kStill_s) say(PointerEvent::Kind::release), pressed_ = true;
        return pressed_ && resting() && time_s_ >= move().duration_s;
      case VisitMove::Kind::wait:
        break;
    }
    return time_s_ >= move().duration_s;
  }

  /// Whether this reach is for a grasp.
  [[nodiscard]] bool takes() const {
    return index_ + 1 < visit_.moves.size() && visit_.moves[index_ + 1].kind == VisitMove::Kind::grasp;
  }

  [[nodiscard]] Vec3 grip_W() const {
    const VisitMove& reach = visit_.moves[last_reach_];
    return X_WB_[reach.body.index()] * reach.p_BG;
  }

  /// A click, if the place is seen on a surface; in the air a pointer touches nothing.
  void touch() {
    const picture::RenderScene scene = shown_.scene(frame_);
    const auto at = pixel_of(sight(scene), grip_W());
    const auto seen = at ? picture::picked_at(scene, shown_.assets(), sight(scene), *at) : std::nullopt;
    if (!seen || !seen->object || (seen->p_WT - grip_W()).norm() > kTouched_m) return;
    at_ = *at;
    say(PointerEvent::Kind::press);
    say(PointerEvent::Kind::release);
    click_ = *seen->object;
  }

  bool take() {
    since_s_ += kPicture_s;
    if (holds()) return time_s_ >= move().duration_s;
    if (pressed_ && since_s_ < kPressPatience_s && !resting()) return false;
    pressed_ = false;
    say(PointerEvent::Kind::release);
    if (!resting()) return false;
    const auto place = place_to_press(presses_++);
    ok_ = place && presses_ <= kPresses;
    if (!ok_) return true;
    at_ = *place;
    pressed_ = true;
    since_s_ = 0;
    say(PointerEvent::Kind::press);
    return false;
  }

  /// Where the body is seen, the nearest to its grip first.
  [[nodiscard]] std::optional<picture::PixelPlace> place_to_press(std::size_t which) {
    constexpr int kRound = 12;
    const picture::RenderScene scene = shown_.scene(frame_);
    const auto grip = pixel_of(sight(), grip_W());
    const auto body = static_cast<std::uint32_t>(move().body.index());
    if (!grip || !under_mouse(scene).takeable(body)) return {};
    std::vector<std::pair<double, picture::PixelPlace>> places;
    for (const double share : {0.0, 0.008, 0.016, 0.03, 0.05, 0.08, 0.12}) {
      for (int k = 0; k < kRound; ++k) {
        const double angle = 2 * kPi * k / kRound;
        const double radius = share * kPicture.height;
        const picture::PixelPlace near{grip->x + radius * std::cos(angle), grip->y + radius * std::sin(angle)};
        const auto seen = picture::picked_at(scene, shown_.assets(), sight(), near);
        if (seen && seen->object == body && apart(near, within(near)) == 0)
          places.emplace_back((seen->p_WT - grip_W()).norm(), near);
        if (share == 0) break;
      }
    }
    if (places.empty()) return which == 0 ? grip : std::nullopt;  // thin: a finger is broad
    std::ranges::sort(places, {}, &std::pair<double, picture::PixelPlace>::first);
    return places[std::min(which * places.size() / kPresses, places.size() - 1)].second;
  }

  bool carry() {
    if (!holds()) {
      since_s_ += kPicture_s;
      ok_ = !lost();
      const bool waits = !resting() && since_s_ < kPressPatience_s;  // for a hand that fetches it again
      return !waits && time_s_ >= move().duration_s;
    }
    const double s = visitor::minimum_jerk(time_s_ / move().duration_s);
    go_to({from_.x + s * (to_.x - from_.x), from_.y + s * (to_.y - from_.y)});
    const double wanted = s * std::log(depth_of(sight(), p_WG_goal_) / from_depth_m_);
    if (time_s_ <= move().duration_s) roll(wanted - rolled_);
    rolled_ = wanted;
    if (time_s_ <= move().duration_s) return false;
    return arrives() || still_s_ > kNotComing_s || time_s_ > move().duration_s + kArrives_s;
  }

  /// Looks whether the hand has come to its goal, and mends the depth that is seen.
  bool arrives() {
    const PointerView view = hand_.view();
    const auto seen = pixel_of(sight(), view.p_WH);
    const bool under = seen && apart(*seen, at_) < kUnderFinger * kPicture.height;
    const double goal_m = depth_of(sight(), p_WG_goal_), is_m = depth_of(sight(), view.p_WH);
    const bool deep = view.drag != PointerView::Drag::carry || std::abs(goal_m - is_m) < kDepth_m;
    since_s_ += kPicture_s;
    if (!deep && since_s_ > kStill_s) {
      roll(std::log(goal_m / is_m));
      since_s_ = 0;
    }
    still_s_ = (view.p_WH - p_WH_seen_).norm() > kMoves_m_per_s * kPicture_s ? 0 : still_s_ + kPicture_s;
    p_WH_seen_ = view.p_WH;
    const Quat R_lies = X_WB_[move().body.index()].R * move().X_WB.R.conjugate();
    return under && deep && rotation_vector(R_lies).norm() < kAskew_rad;
  }

  bool work() {
    const double angle_rad = visitor::joint_angle(joint(), X_WB_);
    const double turned_rad = std::remainder(angle_rad - seen_at_rad_, 2 * kPi);
    seen_at_rad_ = angle_rad;
    seen_rad_ += turned_rad;
    since_s_ = std::abs(turned_rad) > 1e-4 ? 0 : since_s_ + kPicture_s;
    ok_ = ok_ && !lacks();
    if (!round_ || since_s_ > kBlocked_s || resting()) return true;
    const bool over = move().kind == VisitMove::Kind::turn ? turn() : swing();
    go_to(round_->at(finger_rad_));
    return over;
  }

  /// As the hand turns what it holds; where it carries a thing that is fixed to what turns, the way that this really goes.
  [[nodiscard]] std::optional<Round> way_round() {
    constexpr double kLeastRound = 0.4;  // as PointerHand
    const PointerView view = hand_.view();
    if (view.drag == PointerView::Drag::turn) return round_of(sight(), view.axle, view.p_WH, kLeastRound);
    const Pose X_WJ = X_WB_[joint().body1.index()] * joint().X_B1J;
    return round_of(sight(), {X_WJ.p, X_WJ.rotate(Vec3::UnitZ())}, view.p_WH, 0);
  }

  bool turn() {
    const double way = std::copysign(1, move().turns);
    const double whole_rad = std::max(2 * kPi * std::abs(move().turns) - done_rad_[index_], 0.0);
    const double step_rad = 2 * kPi / 60 * move().rate_rpm * kPicture_s;
    finger_rad_ = way * std::min(way * finger_rad_ + step_rad, std::min(way * seen_rad_, whole_rad) + kAhead_rad);
    return way * seen_rad_ >= whole_rad;
  }

  bool swing() {
    const double phase = std::asin(std::clamp(swing_from_rad_ / move().amplitude_rad, -1.0, 1.0));
    const double whole_rad = 2 * kPi * move().cycles;
    const bool lags = std::abs(finger_rad_ - seen_rad_) > std::abs(move().amplitude_rad);
    if (!lags) gone_rad_ += 2 * kPi / 60 * move().cycles_per_min * kPicture_s;
    finger_rad_ = move().amplitude_rad * (std::sin(phase + std::min(gone_rad_, whole_rad)) - std::sin(phase));
    return gone_rad_ >= whole_rad;
  }

  /// Whether the hand lacks a thing that it could have: one that its place or a step has taken is not lost.
  [[nodiscard]] bool lacks() {
    const VisitMove& reach = visit_.moves[last_reach_];
    if (holds() || reach.kind != VisitMove::Kind::reach) return false;
    const auto body = static_cast<std::uint32_t>(reach.body.index());
    const pointer::PointerScene scene = under_mouse(scene_);
    return scene.takeable(body) && std::ranges::none_of(scene.leeway(body).goals, [&](const auto& goal) {
             return goal.turns_too && (goal.X_WB.p - X_WB_[body].p).norm() < kHome_m;
           });
  }
  /// Whether what was carried or worked is in the hand no more, and not where it should be.
  [[nodiscard]] bool lost() {
    if (!lacks()) return false;
    return move().joint || (move().kind == VisitMove::Kind::move_to && visit_.moves[last_reach_].body == move().body &&
                            (X_WB_[move().body.index()].p - move().X_WB.p).norm() > kSlipped_m);
  }

  [[nodiscard]] static picture::Sight sight(const picture::RenderScene& scene) {
    return picture::seen_place(scene.camera, picture::Stereo::mono, kPicture, {})->sight;
  }
  /// The display's camera stands still.
  [[nodiscard]] const picture::Sight& sight() {
    if (!sight_) sight_ = sight(shown_.scene(frame_));
    return *sight_;
  }

  [[nodiscard]] pointer::PointerScene under_mouse(const picture::RenderScene& scene) const {
    return {scene,    shown_.assets(),       picture::Stereo::mono, kPicture, &frame_, shown_.objects(),
            &status_, &shown_.presentation()};
  }

  void say(PointerEvent::Kind kind, double amount = 0) {
    PointerEvent event;
    event.kind = kind;
    event.x = at_.x;
    event.y = at_.y;
    event.amount = amount;
    // Only a press looks at the things.
    if (kind == PointerEvent::Kind::press) scene_ = shown_.scene(frame_);
    input_.take(event, under_mouse(scene_), false);
  }

  void go_to(picture::PixelPlace place) {
    at_ = within(place);
    say(PointerEvent::Kind::move);
  }
  void roll(double deeper) {
    if (hand_.view().drag == PointerView::Drag::carry) say(PointerEvent::Kind::wheel, deeper / kNotch);
  }

  /// A mouse does not leave the screen.
  [[nodiscard]] static picture::PixelPlace within(picture::PixelPlace place) {
    return {std::clamp(place.x, 0.0, kPicture.width - 1.0), std::clamp(place.y, 0.0, kPicture.height - 1.0)};
  }

  ShownExhibit& shown_;
  const state::WorldDescription& description_;
  const state::VisitDescription& visit_;
  pointer::PointerExchange hand_;
  pointer::PointerInput input_;
  std::optional<picture::Sight> sight_;
  picture::RenderScene scene_;  // of the last press
  // As last seen.
  client::Frame frame_;
  client::WorldStatus status_;
  std::vector<Pose> X_WB_;
  bool holding_ = false;
  // What the server knows of the hand.
  state::UserInput user_;
  std::uint64_t ticks_ = 0;
  std::uint64_t commands_ = 1;  // the first began the activity
  std::optional<std::uint32_t> click_;
  // The visit.
  std::vector<visitor::MoveResult> results_;
  std::vector<double> done_rad_;  // of each turn, over all tries
  std::size_t index_ = 0;
  std::size_t last_reach_ = 0;
  int fetched_ = 0;
  picture::PixelPlace at_{kPicture.width / 2.0, kPicture.height / 2.0};  // the mouse
  // This move.
  bool begun_ = false, ok_ = true, pressed_ = false;
  std::size_t presses_ = 0;
  double time_s_ = 0, since_s_ = 0, still_s_ = 0;
  Vec3 p_WH_seen_ = Vec3::Zero();
  picture::PixelPlace from_, to_;
  Vec3 p_WG_goal_ = Vec3::Zero();
  double from_depth_m_ = 0, rolled_ = 0;
  std::optional<Round> round_;
  double seen_rad_ = 0, seen_at_rad_ = 0;  // of the joint: since the move began, and now
  double swing_from_rad_ = 0, gone_rad_ = 0, finger_rad_ = 0;
};

}  // namespace

ShownExhibit::ShownExhibit(const state::WorldDescription& description)
    : objects_(objects_of(description)),
      presentation_(presentation_of(description)),
      library_([folder = std::filesystem::path(description.folder)](const std::string& uri) {
        return import_shapes(folder / uri);
      }),
      builder_(library_, "en") {
  builder_.set_manifest(objects_);
  builder_.set_presentation(presentation_);
}

picture::RenderScene ShownExhibit::scene(const client::Frame& frame) {
  return builder_.build(&frame, nullptr, client::LinkState::joined);
}

std::unique_ptr<Person> make_pointer_person(ShownExhibit& shown, const state::WorldDescription& description,
                                            const state::VisitDescription& visit) {
  return std::make_unique<PointerPerson>(shown, description, visit);
}

}  // namespace mechane::test
