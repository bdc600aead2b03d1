#include "client-sdk/gateway/drafts/preview_desk.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client-sdk/studio/draft/preview_file.hpp"
#include "server/log/log.hpp"
#include <mechane/proto/names.hpp>

namespace mechane::gateway {
namespace {

using PreviewJson = nlohmann::json;

constexpr std::uint32_t kDomainsThere = 230;
constexpr double kMoved_m = 1e-3;
constexpr double kMoved_rad = 1e-2;
constexpr std::string_view kEdit = "edit ";  // how a server's answers to edits begin

bool has_moved(const Pose& from, const Pose& to) {
  return (from.p - to.p).norm() > kMoved_m || rotation_vector(from.R.conjugate() * to.R).norm() > kMoved_rad;
}

PreviewJson reason_json(const studio::StillReason& reason) {
  PreviewJson out{{"kind", reason.kind}, {"text", reason.text}};
  if (!reason.remedy.empty()) out["remedy"] = reason.remedy;
  if (!reason.path.empty()) out["path"] = reason.path;
  return out;
}

/// What its author sees of the world that runs.
void add_world(const KioskHub& hub, const state::WorldDescription& world, const MotionWatch& motion, PreviewJson& out) {
  out["step"] = hub.status()->step;
  out["activity"] = hub.status()->activity;
  out["time_s"] = static_cast<double>(hub.frame()->tick) * kTickSeconds;
  studio::SeenWorld seen{hub.status()->step, hub.status()->enabled_agents, {}, {}, {}};
  motion.tell(seen);
  PreviewJson still = PreviewJson::array();
  for (const studio::StillBody& body : studio::still_bodies(world, seen)) {
    PreviewJson reasons = PreviewJson::array();
    for (const studio::StillReason& reason : body.reasons)
      reasons.push_back(reason_json(reason));
    still.push_back({{"def", body.def}, {"reasons", std::move(reasons)}});
  }
  out["still"] = std::move(still);
}

bool shows_world(const KioskHub* hub) {
  return hub != nullptr && hub->link() == client::LinkState::joined && hub->status() != nullptr &&
         hub->frame() != nullptr;
}

}  // namespace

void MotionWatch::look(const state::WorldDescription& world, const client::Frame& frame) {
  const bool first = now_.empty();
  if (first) moves_.assign(world.bodies.size(), 1);
  now_.clear();
  for (const state::BodyDescription& body : world.bodies)
    now_.push_back(body.X_WB);
  for (const client::BodyPose& body : frame.bodies)
    if (body.object < now_.size()) now_[body.object] = body.X_WB;
  visible_ = frame.visible;
  if (!first && frame.tick < tick_ + kMoment && frame.tick >= tick_) return;
  for (std::size_t i = 0; !first && i < now_.size(); ++i)
    moves_[i] = has_moved(before_[i], now_[i]) ? 1 : 0;
  before_ = now_;
  tick_ = frame.tick;
}

void MotionWatch::tell(studio::SeenWorld& seen) const {
  seen.X_WB = now_;
  seen.visible = visible_;
  seen.moves = moves_;
}

PreviewDesk::PreviewDesk(Places places, const Backstage& backstage)
    : places_(std::move(places)), backstage_(backstage) {
  if (!places_.scenarios.empty()) studio::remove_previews(places_.scenarios);
}

PreviewDesk::~PreviewDesk() {
  for (auto& [draft, preview] : previews_) {
    end_visit(preview);
    if (preview.process) preview.process->end();
    studio::remove_preview(preview.draft.file);
  }
}

std::string PreviewDesk::kiosk_of(const std::string& draft) {
  const std::string kiosk = "studio-" + draft;
  if (kiosk.size() < proto::kNameSize) return kiosk;
  // Longer ones keep their beginning, and what tells them apart.
  std::uint32_t sum = 0;
  for (const char c : draft)
    sum = 31 * sum + static_cast<unsigned char>(c);
  return fmt::format("{}-{:08x}", kiosk.substr(0, proto::kNameSize - 10), sum);
}

Expected<void> PreviewDesk::prepare(const std::string& draft) {
  if (preparing_.contains(draft))
    return fail(ErrorCode::busy, "this draft is just being prepared", {}, "look at it again in a moment");
  std::set<std::string> others = preparing_;
  for (const auto& [name, preview] : previews_)
    if (preview.process && name != draft) others.insert(name);
  if (others.size() >= kMost)
    return fail(ErrorCode::busy, fmt::format("{} drafts are being tried already", kMost), {}, "stop one of them first");
  preparing_.insert(draft);
  return {};
}

void PreviewDesk::start(const std::string& draft, const studio::PreviewDraft* laid, TimePoint now) {
  const auto known = previews_.find(draft);
  if (laid != nullptr && known != previews_.end()) {
    close(draft, known->second, "this draft is tried anew");  // the file is the next one's already
    previews_.erase(known);
  }
  preparing_.erase(draft);
  if (laid == nullptr) return;
  Preview& preview = previews_[draft];
  preview.number = ++numbers_;
  preview.draft = *laid;
  preview.kiosk = kiosk_of(draft);
  preview.domain = free_domain();
  preview.looked = now;
  const std::vector<std::string> arguments{"--scenario",      laid->file.string(),
                                           "--domain",        std::to_string(preview.domain),
                                           "--name",          preview.kiosk,
                                           "--worlds",        "1",
                                           "--records",       "",
                                           "--fifo-priority", "0",
                                           "--paced"};
  auto process = PreviewProcess::start(places_.server, arguments, [this, number = preview.number] {
    backstage_.post([this, number] { ended(number); });
  });
  if (!process) {
    preview.said = {process.error().to_string()};
    places_.remove(laid->file);
    return;
  }
  preview.process = std::move(*process);
  preview.wanted = std::make_shared<const std::monostate>();
  open(preview);
}

/// Lowest first; one that has just ended may still be heard of for a moment.
std::uint32_t PreviewDesk::free_domain() const {
  std::set<std::uint32_t> busy;
  for (const auto& [draft, preview] : previews_)
    busy.insert(preview.domain);
  for (const Ending& one : ending_)
    busy.insert(one.domain);
  std::uint32_t domain = (backstage_.domain + kDomains) % kDomainsThere;
  while (busy.contains(domain))
    domain = (domain + 1) % kDomainsThere;
  return domain;
}

PreviewDesk::Previews::iterator PreviewDesk::find(std::uint64_t number) {
  return std::ranges::find_if(previews_, [number](const auto& entry) { return entry.second.number == number; });
}

void PreviewDesk::open(const Preview& preview) {
  const std::weak_ptr<const std::monostate> wanted = preview.wanted;
  backstage_.slow.give([this, wanted, number = preview.number, domain = preview.domain, post = backstage_.post] {
    if (wanted.expired()) return;
    auto seats = client::DisplaySeats::open(domain);
    if (!seats) return log::error(seats.error());
    post([this, number, shared = std::shared_ptr<client::DisplaySeats>(std::move(*seats))] { opened(number, shared); });
  });
}

void PreviewDesk::opened(std::uint64_t number, std::shared_ptr<client::DisplaySeats> seats) {
  const auto found = find(number);
  if (found == previews_.end() || !found->second.process) return backstage_.end_slowly(std::move(seats));
  Preview& preview = found->second;
  Backstage there = backstage_;
  there.domain = preview.domain;
  there.seats = std::move(seats);
  preview.hub = std::make_shared<KioskHub>(preview.kiosk, there);
  preview.hub->open();
  preview.token = backstage_.tokens.token_for(preview.kiosk, time_now());
}

/// The child has ended without being asked to; one that was asked is not among the previews any more.
void PreviewDesk::ended(std::uint64_t number) {
  const auto found = find(number);
  if (found == previews_.end()) return;
  Preview& preview = found->second;
  preview.said = preview.process->said();
  log::warning(fmt::format("the server that tries {} has ended: {}", found->first,
                           preview.said.empty() ? "it said nothing" : preview.said.back()));
  close(found->first, preview, "the server of this draft has ended");
}

/// What is seen of it ends at once, its server a moment later.
void PreviewDesk::close(const std::string& draft, Preview& preview, const std::string& why) {
  preview.wanted.reset();
  end_visit(preview);
  if (preview.hub) {
    backstage_.tokens.end(preview.kiosk);
    preview.hub->part(why, "look at the studio");
    backstage_.end_slowly(preview.hub->backstage().seats);
    preview.hub.reset();
  }
  if (!preview.process) return;
  preview.process->end();
  ending_.push_back({preview.domain, std::move(preview.process)});
  if (!preparing_.contains(draft)) places_.remove(preview.draft.file);
}

Expected<PreviewDesk::Preview*> PreviewDesk::running(const std::string& draft) {
  const auto found = previews_.find(draft);
  if (found != previews_.end() && found->second.process) return &found->second;
  return fail(ErrorCode::conflict, "this draft is not being tried", {}, "start it first");
}

Expected<void> PreviewDesk::order(const Preview& preview, const std::string& line) {
  if (preview.process->order(line)) return {};
  return fail(ErrorCode::busy, "its server takes no orders now", {}, "try again in a moment");
}

Expected<void> PreviewDesk::set_pace(const std::string& draft, double pace) {
  auto preview = running(draft);
  if (!preview) return tl::unexpected(preview.error());
  if (auto given = order(**preview, fmt::format("pace {}", pace)); !given) return given;
  (*preview)->pace = pace;
  return {};
}

Expected<void> PreviewDesk::step(const std::string& draft, std::uint32_t ticks) {
  auto preview = running(draft);
  if (!preview) return tl::unexpected(preview.error());
  if ((*preview)->pace != 0) return fail(ErrorCode::conflict, "its time runs", {}, "pause it first");
  return order(**preview, fmt::format("step {}", ticks));
}

Expected<void> PreviewDesk::play(const std::string& draft, const std::string& visit) {
  auto found = running(draft);
  if (!found) return tl::unexpected(found.error());
  Preview& preview = **found;
  const auto has_name = [&visit](const state::VisitDescription& one) { return one.name == visit; };
  if (!visit.empty() && std::ranges::none_of(preview.draft.world->visits, has_name))
    return fail(ErrorCode::unknown_name, fmt::format("what runs has no visit '{}'", visit), "visit",
                "start the draft anew, so that it runs as it is now");
  if (!visit.empty() && !shows_world(preview.hub.get()))
    return fail(ErrorCode::conflict, "this draft is still starting", {}, "try again in a moment");
  end_visit(preview);
  preview.played.reset();
  if (visit.empty()) return {};
  if (auto paced = set_pace(draft, 1); !paced) return paced;
  auto played = PlayedVisit::start(places_.visitor, {preview.draft.file, preview.domain, preview.kiosk, visit},
                                   [this, number = preview.number, one = ++preview.visits] {
                                     backstage_.post([this, number, one] { visit_ended(number, one); });
                                   });
  if (!played) return tl::unexpected(played.error());
  preview.played = std::move(*played);
  return {};
}

Expected<std::string> PreviewDesk::editable(const std::string& draft) {
  auto preview = running(draft);
  if (!preview) return tl::unexpected(preview.error());
  if ((*preview)->played && (*preview)->played->plays())
    return fail(ErrorCode::conflict, "a visitor plays in what runs", {}, "wait until the visit ends, or end it");
  return (*preview)->draft.step;
}

Expected<void> PreviewDesk::edit(const std::string& draft, studio::PreviewDraft laid) {
  auto preview = running(draft);
  if (!preview) return tl::unexpected(preview.error());
  if (laid.step != (*preview)->draft.step)
    return fail(ErrorCode::conflict, "this draft was started anew meanwhile", {}, "it runs as it is now");
  if (auto given = order(**preview, fmt::format("edit {}", laid.revision)); !given) return given;
  (*preview)->edited = std::move(laid);
  return {};
}

/// Takes the answers to edits out of what the server has said.
void PreviewDesk::hear_edits(Preview& preview, std::vector<std::string>& said) {
  for (const std::string& line : said) {
    if (!preview.edited || !line.starts_with(fmt::format("{}{} ", kEdit, preview.edited->revision))) continue;
    const std::string answer = line.substr(line.find(' ', kEdit.size()) + 1);
    if (answer == "taken") {
      preview.draft = std::move(*preview.edited);
      preview.kept_from = -1;
    } else {
      preview.kept_from = preview.edited->revision;
      preview.kept_by = answer;
    }
    preview.edited.reset();
  }
  std::erase_if(said, [](const std::string& line) { return line.starts_with(kEdit); });
}

void PreviewDesk::end_visit(Preview& preview) {
  if (!preview.played) return;
  if (auto process = preview.played->end()) ending_.push_back({preview.domain, std::move(process)});
}

void PreviewDesk::visit_ended(std::uint64_t number, std::uint64_t visit) {
  const auto found = find(number);
  if (found != previews_.end() && found->second.visits == visit && found->second.played)
    found->second.played->note_end();
}

Expected<void> PreviewDesk::ask_device(const std::string& draft, const client::DeviceRequest& request, TimePoint now) {
  auto found = running(draft);
  if (!found) return tl::unexpected(found.error());
  KioskHub* hub = (*found)->hub.get();
  if (!shows_world(hub))
    return fail(ErrorCode::conflict, "this draft is still starting", {}, "wait until it shows its world");
  return hub->asked_devices().ask(*hub->client(), request, now);
}

void PreviewDesk::stop(const std::string& draft) {
  const auto found = previews_.find(draft);
  if (found == previews_.end()) return;
  close(draft, found->second, "this draft is not tried any more");
  previews_.erase(found);
}

std::string PreviewDesk::look(const std::string& draft, TimePoint now) {
  const auto found = previews_.find(draft);
  if (found == previews_.end()) return PreviewJson{{"state", preparing_.contains(draft) ? "starting" : "none"}}.dump();
  Preview& preview = found->second;
  preview.looked = now;
  std::vector<std::string> said = preview.process ? preview.process->said() : preview.said;
  hear_edits(preview, said);
  PreviewJson out{{"revision", preview.draft.revision}, {"pace", preview.pace}};
  if (preview.kept_from >= 0) out["kept"] = {{"revision", preview.kept_from}, {"by", preview.kept_by}};
  if (!preview.draft.step.empty()) out["begins"] = preview.draft.step;
  if (!preview.process) {
    out["state"] = "failed";
  } else {
    out["state"] = shows_world(preview.hub.get()) ? "running" : "starting";
  }
  out["said"] = std::move(said);
  if (preview.played) out["visit"] = preview.played->to_json();
  if (preview.hub) {
    backstage_.tokens.use(preview.token, now);
    out["kiosk"] = preview.kiosk;
    out["domain"] = preview.domain;
    out["address"] = fmt::format("/kiosk/{}?token={}", preview.kiosk, preview.token);
    out["socket"] = fmt::format("/ws/kiosk/{}?token={}", preview.kiosk, preview.token);
    if (shows_world(preview.hub.get())) {
      add_world(*preview.hub, *preview.draft.world, preview.motion, out);
      out["devices"] = preview.hub->devices_json(now);
    }
  }
  return out.dump(-1, ' ', false, PreviewJson::error_handler_t::replace);
}

std::shared_ptr<KioskHub> PreviewDesk::hub_of(const std::string& kiosk) const {
  for (const auto& [draft, preview] : previews_)
    if (preview.kiosk == kiosk) return preview.hub;
  return nullptr;
}

void PreviewDesk::tick(TimePoint now) {
  std::vector<std::string> unseen;
  for (auto& [draft, preview] : previews_) {
    if (preview.hub) {
      preview.hub->tick(now);
      if (preview.hub->browsers() > 0) preview.looked = now;
      if (shows_world(preview.hub.get())) preview.motion.look(*preview.draft.world, *preview.hub->frame());
    }
    if (now - preview.looked > kStaysUnseen) unseen.push_back(draft);
  }
  for (const std::string& draft : unseen)
    stop(draft);
  std::erase_if(ending_, [](const Ending& one) { return one.process->over(); });
}

}  // namespace mechane::gateway
