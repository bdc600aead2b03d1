#include "client-sdk/gateway/preview_api.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "client-sdk/gateway/browsers/asked_devices.hpp"
#include "client-sdk/gateway/studio_api.hpp"
#include "client-sdk/studio/edits/command.hpp"
#include "client-sdk/studio/shelf/shelf.hpp"

namespace mechane::gateway {
namespace {

using PaceJson = nlohmann::json;

constexpr std::uint32_t kMostTicks = 10'000;

HttpAnswer looked_at(GatewaySite& site, const std::string& draft) {
  return fresh_answer(site.previews().look(draft, time_now()));
}

using LaidOut = std::optional<studio::PreviewDraft>;

/// `then` hears on the loop's thread of the draft that was laid out, or, where that is empty, why not.
void lay_out(GatewaySite& site, const std::string& draft, const studio::TrialRequest& wanted,
             std::function<void(LaidOut, HttpAnswer)> then) {
  const auto laid = std::make_shared<LaidOut>();
  site.studio().give(
      [draft, laid, wanted](studio::Shelf& shelf) {
        auto draft_laid = shelf.lay_out(draft, wanted.revision, wanted.step);
        if (!draft_laid) return fault_answer(draft_laid.error());
        *laid = std::move(*draft_laid);
        return fresh_answer("{}");
      },
      [laid, then = std::move(then)](HttpAnswer answer) { then(std::move(*laid), std::move(answer)); });
}

void start_preview(GatewaySite& site, const std::string& draft, const std::string& body, const Site::Done& done) {
  const auto wanted = studio::parse_trial(body);
  if (!wanted) return done(fault_answer({wanted.error()}));
  if (site.knows_kiosk(PreviewDesk::kiosk_of(draft)))
    return done(refusal(409, "a kiosk of the museum has the name that this draft would be tried under",
                        "give the draft, or the kiosk, another name"));
  if (auto room = site.previews().prepare(draft); !room) return done(refusal(room.error()));
  lay_out(site, draft, *wanted, [&site, draft, done](LaidOut laid, HttpAnswer refused) {
    site.previews().start(draft, laid ? &*laid : nullptr, time_now());
    done(laid ? looked_at(site, draft) : std::move(refused));
  });
}

void edit_preview(GatewaySite& site, const std::string& draft, const std::string& body, const Site::Done& done) {
  const auto revision = studio::parse_revision(body);
  if (!revision) return done(fault_answer({revision.error()}));
  const auto step = site.previews().editable(draft);
  if (!step) return done(refusal(step.error()));
  lay_out(site, draft, {*revision, *step}, [&site, draft, done](LaidOut laid, HttpAnswer refused) {
    if (!laid) return done(std::move(refused));
    const auto edited = site.previews().edit(draft, std::move(*laid));
    done(edited ? looked_at(site, draft) : refusal(edited.error()));
  });
}

void pace_preview(GatewaySite& site, const std::string& draft, const std::string& body, const Site::Done& done) {
  const auto wanted = parse_pace(body);
  if (!wanted) return done(refusal(wanted.error()));
  const auto done_so =
      wanted->ticks > 0 ? site.previews().step(draft, wanted->ticks) : site.previews().set_pace(draft, wanted->pace);
  done(done_so ? looked_at(site, draft) : refusal(done_so.error()));
}

void play_visit(GatewaySite& site, const std::string& draft, const std::string& body, const Site::Done& done) {
  const auto wanted = parse_visit_order(body);
  if (!wanted) return done(refusal(wanted.error()));
  const auto played = site.previews().play(draft, *wanted);
  done(played ? looked_at(site, draft) : refusal(played.error()));
}

void ask_device(GatewaySite& site, const std::string& draft, const std::string& body, const Site::Done& done) {
  const auto wanted = parse_device_order(body);
  if (!wanted) return done(refusal(wanted.error()));
  const auto asked = site.previews().ask_device(draft, *wanted, time_now());
  done(asked ? looked_at(site, draft) : refusal(asked.error()));
}

}  // namespace

Expected<PaceRequest> parse_pace(const std::string& body) {
  const PaceJson json = PaceJson::parse(body, nullptr, false);
  if (json.is_object() && json.size() == 1) {
    const auto pace = json.find("pace"), ticks = json.find("ticks");
    if (pace != json.end() && pace->is_number() && pace->get<double>() >= 0 && pace->get<double>() <= 1)
      return PaceRequest{pace->get<double>(), 0};
    if (ticks != json.end() && ticks->is_number_unsigned() && ticks->get<std::uint64_t>() >= 1 &&
        ticks->get<std::uint64_t>() <= kMostTicks)
      return PaceRequest{1, ticks->get<std::uint32_t>()};
  }
  return fail(ErrorCode::invalid_value, "a pace or a number of ticks is missing, or out of range", {},
              R"(send {"pace": 0 to 1} or {"ticks": 1 to 10000})");
}

Expected<std::string> parse_visit_order(const std::string& body) {
  const PaceJson json = PaceJson::parse(body, nullptr, false);
  if (json.is_object() && json.size() == 1)
    if (const auto visit = json.find("visit"); visit != json.end() && visit->is_string())
      return visit->get<std::string>();
  return fail(ErrorCode::invalid_value, "the request names no visit", {}, R"(send {"visit": NAME}, or "" to end one)");
}

bool is_preview_verb(const std::string& verb) {
  return verb == "preview" || verb == "preview/stop" || is_passing(verb);
}

bool is_passing(const std::string& verb) {
  return verb == "preview/pace" || verb == "preview/visit" || verb == "preview/edit" || verb == "preview/device";
}

bool answer_preview_get(GatewaySite& site, const std::string& draft, const std::string& verb, const Site::Done& done) {
  if (verb != "preview") return false;
  return done(looked_at(site, draft)), true;
}

void answer_preview_post(GatewaySite& site, const std::string& draft, const std::string& verb, const std::string& body,
                         const Site::Done& done) {
  if (verb == "preview") return start_preview(site, draft, body, done);
  if (verb == "preview/pace") return pace_preview(site, draft, body, done);
  if (verb == "preview/edit") return edit_preview(site, draft, body, done);
  if (verb == "preview/visit") return play_visit(site, draft, body, done);
  if (verb == "preview/device") return ask_device(site, draft, body, done);
  site.previews().stop(draft);
  done(looked_at(site, draft));
}

}  // namespace mechane::gateway
