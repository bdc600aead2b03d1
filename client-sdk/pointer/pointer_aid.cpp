#include "client-sdk/pointer/pointer_aid.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::pointer {
namespace {

const Eigen::Vector4f kGold(0.98F, 0.80F, 0.36F, 0.95F);
const Eigen::Vector4f kWater(0.55F, 0.86F, 0.96F, 0.90F);
const Eigen::Vector4f kShade(0.05F, 0.06F, 0.08F, 0.45F);

/// Dots of one size, each with a dark rim, so that they are visible on stone and on sky.
class DotPen {
 public:
  DotPen(picture::OverlayContent& content, const picture::Sight& sight)
      : content_(content), sight_(sight), unit_(static_cast<float>(sight.picture.height) / 720) {}

  void dot(picture::PixelPlace at, float radius, const Eigen::Vector4f& colour) {
    const auto x = static_cast<float>(at.x);
    const auto y = static_cast<float>(at.y);
    content_.dots.push_back({x, y, (radius + 1.4F) * unit_, kShade});
    content_.dots.push_back({x, y, radius * unit_, colour});
  }
  void ring(picture::PixelPlace middle, double radius, const Eigen::Vector4f& colour) {
    constexpr int kDots = 20;
    for (int k = 0; k < kDots; ++k) {
      const double angle = 2 * kPi * k / kDots;
      dot({middle.x + radius * unit_ * std::cos(angle), middle.y + radius * unit_ * std::sin(angle)}, 1.8F, colour);
    }
  }
  void line(picture::PixelPlace from, picture::PixelPlace to, const Eigen::Vector4f& colour) {
    const double apart = std::hypot(to.x - from.x, to.y - from.y);
    const double gap = 11.0 * unit_;
    const int dots = std::min(static_cast<int>(apart / gap), 200);
    for (int k = 1; k < dots; ++k) {
      const double s = k * gap / apart;
      dot({from.x + s * (to.x - from.x), from.y + s * (to.y - from.y)}, 1.6F, colour);
    }
  }
  /// Points along the hand's circle, in the world.
  void circle(const AffordanceLine& axle, const Vec3& p_WH, double radius_m) {
    const Vec3 arm = p_WH - axle.p_W;
    const Vec3 across = arm - arm.dot(axle.a_W) * axle.a_W;
    if (across.norm() < 1e-6) return;
    const Vec3 x_W = radius_m * across.normalized();
    const Vec3 y_W = axle.a_W.cross(x_W);
    // Spaced by the room that the picture has.
    std::optional<picture::PixelPlace> last;
    for (int k = 0; k < 360; ++k) {
      const double angle = 2 * kPi * k / 360;
      const auto at = picture::pixel_of(sight_, axle.p_W + std::cos(angle) * x_W + std::sin(angle) * y_W);
      if (!at || (last && std::hypot(at->x - last->x, at->y - last->y) < 9.0 * unit_)) continue;
      dot(*at, 1.6F, kWater);
      last = at;
    }
  }

 private:
  picture::OverlayContent& content_;
  const picture::Sight& sight_;
  float unit_;
};

std::string carried_note(PointerMeans means, bool greek) {
  if (means == PointerMeans::fingers)
    return greek ? "Σύρετε για να το μεταφέρετε· με δύο δάχτυλα το στρίβετε, το φέρνετε κοντά ή μακριά"
                 : "Drag to carry it; two fingers turn it, bring it nearer or farther";
  if (means == PointerMeans::keys)
    return greek ? "Τα βέλη το μεταφέρουν· Q και E το στρίβουν, Page Up και Page Down το πάνε μακριά ή κοντά"
                 : "Arrows carry it; Q and E turn it, Page Up and Page Down bring it farther or nearer";
  return greek ? "Σύρετε για να το μεταφέρετε· με το δεξί κουμπί πατημένο στρίβει, με τον τροχό πάει μακριά ή κοντά"
               : "Drag to carry it; hold the right button to turn it; the wheel brings it farther or nearer";
}

std::string goal_note(PointerMeans means, bool greek) {
  const std::string bring = greek ? "Φέρτε το στον γαλάζιο κύκλο· " : "Bring it to the blue ring; ";
  if (means == PointerMeans::fingers) return bring + (greek ? "με δύο δάχτυλα στρίβει" : "two fingers turn it");
  if (means == PointerMeans::keys) return bring + (greek ? "με τα Q και E στρίβει" : "Q and E turn it");
  return bring + (greek ? "με το δεξί κουμπί πατημένο στρίβει, με τον τροχό πάει μακριά ή κοντά"
                        : "hold the right button to turn it; the wheel brings it farther or nearer");
}

std::string held_note(PointerView::Drag drag, bool has_goal, PointerMeans means, bool greek) {
  const bool keys = means == PointerMeans::keys;
  if (drag == PointerView::Drag::turn) {
    if (keys)
      return greek ? "Τα βέλη το γυρίζουν· με το πλήκτρο διαστήματος το αφήνετε" : "Arrows turn it; Space lets go";
    return greek ? "Κάντε κύκλους, όπως δείχνουν οι κουκκίδες" : "Drag round and round, along the dots";
  }
  if (drag == PointerView::Drag::slide) {
    if (keys)
      return greek ? "Τα βέλη το σέρνουν· με το πλήκτρο διαστήματος το αφήνετε"
                   : "Arrows move it along its way; Space lets go";
    return greek ? "Σύρετε κατά μήκος" : "Drag it along its way";
  }
  if (has_goal) return goal_note(means, greek);
  return carried_note(means, greek);
}

std::string note_of(const PointerAid& aid, bool greek) {
  using Phase = PointerView::Phase;
  if (aid.link == PointerLinkState::refused)
    return greek ? "Όλα τα χέρια είναι απασχολημένα" : "All hands are busy at the moment";
  if (aid.view.phase == Phase::holding) return held_note(aid.view.drag, aid.view.p_WG.has_value(), aid.means, greek);
  if (aid.view.phase == Phase::resting && aid.p_WT && aid.means == PointerMeans::keys)
    return greek ? "Με το πλήκτρο διαστήματος το πιάνετε, με το Tab πάτε στο επόμενο"
                 : "Space takes it; Tab goes to the next";
  if (aid.view.phase == Phase::resting && aid.p_WT)
    return greek ? "Πατήστε και κρατήστε για να το πιάσετε" : "Press and hold to take it";
  return {};
}

}  // namespace

void add_pointer_aid(const PointerAid& aid, const std::string& language, picture::OverlayContent& content) {
  using Phase = PointerView::Phase;
  DotPen pen(content, aid.sight);
  if (aid.focus) {
    pen.ring(*aid.focus, 30, kGold);
    pen.dot(*aid.focus, 3, kGold);
  }
  if (aid.view.phase == Phase::resting) {
    const auto at = aid.p_WT ? picture::pixel_of(aid.sight, *aid.p_WT) : std::nullopt;
    if (at) pen.ring(*at, 20, kGold);
  } else if (const auto hand = picture::pixel_of(aid.sight, aid.view.p_WH)) {
    const bool holds = aid.view.phase == Phase::holding;
    if (holds && aid.view.drag == PointerView::Drag::turn) pen.circle(aid.view.axle, aid.view.p_WH, aid.view.radius_m);
    if (const auto goal = aid.view.p_WG ? picture::pixel_of(aid.sight, *aid.view.p_WG) : std::nullopt) {
      pen.line(*hand, *goal, kWater);
      pen.ring(*goal, 24, kWater);
    }
    if (aid.view.phase != Phase::leaving) pen.line(aid.view.pointer, *hand, kGold);
    pen.ring(*hand, holds ? 13 : 20, kGold);
  }
  if (content.note.empty()) content.note = note_of(aid, language == "el");
}

std::optional<picture::OverlayButton> go_on_button(const client::WorldStatus* status, const std::string& language) {
  if (status == nullptr || !status->done || status->activities.empty()) return {};
  const auto here = std::ranges::find(status->activities, status->activity);
  const bool last = here == status->activities.end() || here + 1 == status->activities.end();
  const bool greek = language == "el";
  picture::OverlayButton button;
  button.action = {picture::OverlayAction::Kind::activity, last ? status->activities.front() : *(here + 1)};
  button.text = last ? (greek ? "Ξανά" : "Again") : (greek ? "Συνέχεια" : "Continue");
  return button;
}

}  // namespace mechane::pointer
