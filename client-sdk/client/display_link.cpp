#include "client-sdk/client/display_link.hpp"

#include <algorithm>
#include <chrono>

#include "client-sdk/client/parse.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {
namespace {

void write_numbers(const DisplayStatus& status, proto::DisplayStatus& wire) {
  wire.process_id = status.process_id;
  wire.uptime_s = status.uptime_s;
  wire.width = status.width;
  wire.height = status.height;
  wire.offscreen = status.offscreen;
  wire.pictures = status.pictures;
  wire.pictures_per_s = static_cast<float>(status.pictures_per_s);
  wire.picture_ms_median = static_cast<float>(status.picture_ms_median);
  wire.picture_ms_p99 = static_cast<float>(status.picture_ms_p99);
  wire.wanted_per_s = static_cast<float>(status.wanted_per_s);
  wire.link = status.link;
  wire.frames_per_s = static_cast<float>(status.frames_per_s);
  wire.frames_lost = static_cast<float>(std::clamp(status.frames_lost, 0.0, 1.0));
  wire.missing_total = status.missing_total;
  wire.warnings = status.warnings;
}

/// The wire's texts point into the status, which must outlive them.
void look_at_texts(const DisplayStatus& status, proto::DisplayStatus& wire) {
  wire.version = proto::look_into(status.version);
  wire.host = proto::look_into(status.host);
  wire.refusal = proto::look_into(status.refusal);
  wire.world = proto::look_into(status.world);
  wire.scenario = proto::look_into(status.scenario);
  wire.renderer = proto::look_into(status.renderer);
  wire.sound = proto::look_into(status.sound);
  wire.sound_problem = proto::look_into(status.sound_problem);
  wire.showing = proto::look_into(status.showing);
  wire.last_warning = proto::look_into(status.last_warning);
}

std::vector<proto::WireSetting> to_wire(const std::vector<DisplaySetting>& settings) {
  std::vector<proto::WireSetting> all(settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i) {
    proto::set_text(all[i].name, settings[i].name);
    proto::set_text(all[i].value, settings[i].value);
  }
  return all;
}

TimePoint now_here() {
  return std::chrono::steady_clock::now();
}

}  // namespace

Expected<std::unique_ptr<DisplayLink>> DisplayLink::create(const proto::Participant& participant,
                                                           const std::string& kiosk, const std::string& display,
                                                           std::uint64_t session) {
  std::unique_ptr<DisplayLink> made(new DisplayLink(kiosk, display, session));
  auto writer = proto::Writer<proto::DisplayStatus>::create(participant, "");
  if (!writer) return tl::unexpected(writer.error());
  made->statuses_ = std::move(*writer);
  DisplayLink* const raw = made.get();
  auto reader = proto::Reader<proto::DisplayRequest>::create(participant, "", [raw](auto view) { raw->take(view); });
  if (!reader) return tl::unexpected(reader.error());
  made->request_reader_ = std::move(*reader);
  auto heads = proto::Reader<proto::ViewerHead>::create(participant, "", [raw](auto view) { raw->take(view); });
  if (!heads) return tl::unexpected(heads.error());
  made->head_reader_ = std::move(*heads);
  return made;
}

bool DisplayLink::report(const DisplayStatus& status) {
  proto::DisplayStatus wire{};
  proto::set_text(wire.kiosk, kiosk_);
  proto::set_text(wire.display, display_);
  wire.session = session_;
  wire.protocol = proto::kProtocol;
  wire.seq = ++sequence_;
  wire.sent_ns = to_ns(now_here());
  write_numbers(status, wire);
  look_at_texts(status, wire);
  std::vector<char*> missing = proto::pointers_to(status.missing);
  std::vector<proto::WireSetting> settings = to_wire(status.settings);
  std::vector<proto::WireRequestAnswer> answers;
  for (const RequestAnswer& answer : status.answers)
    answers.push_back({answer.id, proto::look_into(answer.refusal), proto::look_into(answer.picture)});
  proto::look_into(wire.missing, missing);
  proto::look_into(wire.settings, settings);
  proto::look_into(wire.answers, answers);
  return statuses_.write(wire);
}

/// A request without a display's name is for all displays of the kiosk.
bool DisplayLink::is_meant(std::string_view kiosk, std::string_view display) const {
  return kiosk == kiosk_ && (display.empty() || display == display_);
}

void DisplayLink::take(proto::ReaderView<proto::DisplayRequest> view) {
  view.take_each([this](const proto::DisplayRequest& wire, const proto::SampleInfo& info) {
    if (!info.valid || !is_meant(proto::text_of(wire.kiosk), proto::text_of(wire.display))) return;
    DisplayRequest request;
    if (!parse(wire, request)) return;
    requests_.push(std::move(request));
  });
}

void DisplayLink::take(proto::ReaderView<proto::ViewerHead> view) {
  view.take_each([this](const proto::ViewerHead& wire, const proto::SampleInfo& info) {
    if (!info.valid || !is_meant(proto::text_of(wire.kiosk), proto::text_of(wire.display))) return;
    ViewerHead head;
    if (!parse(wire, head)) return;
    head.received = now_here();
    const std::lock_guard lock(mutex_);
    head_ = head;
  });
}

std::optional<ViewerHead> DisplayLink::viewer_head() {
  const std::lock_guard lock(mutex_);
  return head_;
}

}  // namespace mechane::client
