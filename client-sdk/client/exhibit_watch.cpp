#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "client-sdk/client/exhibit_parse.hpp"
#include "server/realtime/wakeup.hpp"
#include <mechane/client/exhibits.hpp>
#include <mechane/proto/convert.hpp>
#include <mechane/proto/entity.hpp>
#include <mechane/proto/exhibit_key.hpp>
#include <mechane/proto/identity.hpp>

namespace mechane::client {
namespace {

static_assert(mechane_exhibit_load == static_cast<int>(ExhibitVerb::load));
static_assert(mechane_exhibit_replace == static_cast<int>(ExhibitVerb::replace));
static_assert(mechane_exhibit_retire == static_cast<int>(ExhibitVerb::retire));

class ExhibitWatchImpl final : public ExhibitWatch {
 public:
  explicit ExhibitWatchImpl(proto::Participant participant) : participant_(std::move(participant)) {}

  [[nodiscard]] Expected<void> open() {
    auto writer = proto::Writer<proto::ExhibitRequest>::create(participant_, "");
    if (!writer) return tl::unexpected(writer.error());
    requests_ = std::move(*writer);
    auto reader = proto::Reader<proto::ExhibitStatus>::create(participant_, "", [this](auto) { news_.signal(); });
    if (!reader) return tl::unexpected(reader.error());
    reader_ = std::move(*reader);
    return {};
  }

  void wait(Duration timeout) override { news_.wait(timeout); }

  [[nodiscard]] std::vector<ExhibitStatus> servers() override {
    reader_.view().take_each([this](const proto::ExhibitStatus& wire, const proto::SampleInfo& info) {
      const std::string server(proto::text_of(wire.server));
      ExhibitStatus status;
      if (!info.alive) {
        known_.erase(server);
      } else if (info.valid && parse(wire, status) && (known_.size() < kMostServers || known_.contains(server))) {
        known_[server] = std::move(status);
      }
    });
    std::vector<ExhibitStatus> all;
    for (const auto& [server, status] : known_)
      all.push_back(status);
    return all;
  }

  [[nodiscard]] Expected<std::uint64_t> request(const std::string& server, const ExhibitRequest& request,
                                                const std::filesystem::path& key_file) override {
    if (!proto::is_exhibit_name(request.exhibit)) {
      return fail(ErrorCode::invalid_value,
                  fmt::format("'{}' cannot be the name of an exhibit", request.exhibit.substr(0, 64)), "exhibit",
                  "use 1 to 63 characters of A-Z a-z 0-9 - and _");
    }
    const auto known = known_.find(server);
    if (known == known_.end())
      return fail(ErrorCode::unknown_name, "no server of this name runs in this DDS domain", server,
                  "check its name, and that it runs");
    ExhibitStatus& status = known->second;
    if (!status.changeable) {
      return fail(ErrorCode::not_supported, "this server takes no changes of exhibits", server,
                  "start it with a folder of records, or with --exhibit-key FILE");
    }
    const auto key = proto::ExhibitKey::read(key_file);
    if (!key) return tl::unexpected(key.error());
    if (key->mark() != status.key_mark) {
      return fail(ErrorCode::conflict, "this is not the key of server " + server, key_file.string(),
                  "name the server's own key file, exhibits.key in its folder of records, or a copy of it");
    }
    proto::ExhibitRequest wire{};
    proto::set_text(wire.server, server);
    wire.protocol = proto::kProtocol;
    wire.seq = ++sequence_;
    wire.sent_ns = to_ns(std::chrono::steady_clock::now());
    wire.id = proto::random_id();
    wire.incarnation = status.incarnation;
    wire.counter = ++status.counter;  // so that a second request, sent before the server's word, has the next one
    wire.verb = static_cast<std::uint32_t>(request.verb);
    proto::set_text(wire.exhibit, request.exhibit);
    wire.now = request.now;
    key->seal(wire);
    if (!requests_.write(wire))
      return fail(ErrorCode::io_failure, "the request could not be sent", server, "try again");
    return wire.id;
  }

 private:
  proto::Participant participant_;
  std::uint64_t sequence_ = 0;
  std::map<std::string, ExhibitStatus> known_;
  realtime::Wakeup news_;
  proto::Writer<proto::ExhibitRequest> requests_;
  proto::Reader<proto::ExhibitStatus> reader_;  // last: its listener ends first
};

}  // namespace

std::optional<ExhibitVerb> exhibit_verb(std::string_view word) {
  if (word == "load") return ExhibitVerb::load;
  if (word == "replace") return ExhibitVerb::replace;
  if (word == "retire") return ExhibitVerb::retire;
  return std::nullopt;
}

std::optional<ExhibitAnswer> ExhibitWatch::answer(std::uint64_t id) {
  for (const ExhibitStatus& status : servers()) {
    const auto found = std::ranges::find(status.answers, id, &ExhibitAnswer::id);
    if (found != status.answers.end()) return *found;
  }
  return std::nullopt;
}

Expected<std::unique_ptr<ExhibitWatch>> ExhibitWatch::open(std::uint32_t domain) {
  auto participant = proto::Participant::create(domain);
  if (!participant) return tl::unexpected(participant.error());
  auto watch = std::make_unique<ExhibitWatchImpl>(std::move(*participant));
  if (auto opened = watch->open(); !opened) return tl::unexpected(opened.error());
  return watch;
}

}  // namespace mechane::client
