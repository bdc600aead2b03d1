#include "server/app/exhibit_desk.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "server/app/exhibit_changes.hpp"
#include "server/log/log.hpp"

namespace mechane::app {
namespace {

using transport::ExhibitOrder;
using transport::ExhibitVerb;

constexpr std::size_t kMostAnswers = 8;
constexpr std::size_t kMostLoadable = 256;
constexpr Duration kListEvery = std::chrono::seconds(2);

std::string_view word_of_verb(ExhibitVerb verb) {
  switch (verb) {
    case ExhibitVerb::load:
      return "load";
    case ExhibitVerb::replace:
      return "replace";
    case ExhibitVerb::retire:
      return "retire";
  }
  return "";
}

bool is_file(const std::filesystem::path& path) {
  std::error_code code;
  return std::filesystem::is_regular_file(path, code);
}

}  // namespace

std::filesystem::path exhibits_folder(const Settings& settings, const ScenarioStore& scenarios) {
  if (!settings.exhibits.empty()) return settings.exhibits;
  std::error_code code;
  const auto home = std::filesystem::absolute(scenarios.file_of(scenarios.first()->id), code);
  return home.parent_path().parent_path();
}

Expected<std::filesystem::path> exhibit_file(const std::filesystem::path& folder, const std::string& name) {
  if (!proto::is_exhibit_name(name)) {
    return fail(ErrorCode::invalid_value, "this cannot be the name of an exhibit", folder.string(),
                "use 1 to 63 characters of A-Z a-z 0-9 - and _");
  }
  std::filesystem::path file = folder / name / (name + ".x3d");
  if (!is_file(file)) file = folder / (name + ".x3d");
  if (!is_file(file)) {
    return fail(ErrorCode::not_found, fmt::format("there is no exhibit '{}'", name), folder.string(),
                fmt::format("put its file there, as {0}/{0}.x3d; mechane exhibits lists what is there", name));
  }
  std::error_code code;
  const auto inside =
      std::filesystem::canonical(file, code).lexically_relative(std::filesystem::canonical(folder, code));
  if (code || inside.empty() || *inside.begin() == "..") {
    return fail(ErrorCode::conflict, "the exhibit's file is a link that leads out of the folder of exhibits",
                file.string(), "put the file itself there");
  }
  return file;
}

std::vector<std::string> exhibits_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code code;
  for (std::filesystem::directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    const std::string name =
        it->path().extension() == ".x3d" ? it->path().stem().string() : it->path().filename().string();
    if (proto::is_exhibit_name(name) && exhibit_file(folder, name)) names.push_back(name);
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  if (names.size() > kMostLoadable) names.resize(kMostLoadable);
  return names;
}

Expected<std::filesystem::path> file_of_order(const ExhibitOrder& order, const ScenarioStore& scenarios,
                                              const std::filesystem::path& folder) {
  const bool loaded = scenarios.find(order.exhibit) != nullptr;
  if (order.verb == ExhibitVerb::load) {
    if (!loaded) return exhibit_file(folder, order.exhibit);
    return fail(ErrorCode::conflict, fmt::format("'{}' is loaded already", order.exhibit), order.exhibit,
                "replace it, where its file has changed");
  }
  if (!loaded) {
    return fail(ErrorCode::unknown_name, fmt::format("this server has no exhibit '{}'", order.exhibit), order.exhibit,
                "load it first; mechane exhibits lists what there is");
  }
  if (order.verb == ExhibitVerb::replace) return scenarios.file_of(order.exhibit);
  if (order.exhibit == scenarios.first()->id) {
    return fail(ErrorCode::conflict,
                fmt::format("'{}' is home: kiosks begin there, and come back there", order.exhibit), order.exhibit,
                "replace it, or start the server with another scenario first");
  }
  return std::filesystem::path();
}

ExhibitDesk::ExhibitDesk(const Settings& settings, std::vector<std::string> of_settings, ScenarioStore& scenarios,
                         transport::ServerTransport& transport, Lobby& lobby, Worker& reader)
    : settings_(settings),
      of_settings_(std::move(of_settings)),
      scenarios_(scenarios),
      transport_(transport),
      lobby_(lobby),
      reader_(reader),
      folder_(exhibits_folder(settings, scenarios)) {}

void ExhibitDesk::look(TimePoint now) {
  for (ExhibitOrder& order : transport_.take_exhibit_orders(now)) {
    if (waiting_.size() < kMostWaiting) {
      waiting_.push_back(std::move(order));
    } else {
      answer(order, fail(ErrorCode::busy, "too many requests are waiting", order.exhibit, "ask again in a while"));
    }
  }
  if (preparing_) {
    if (!is_ready(reading_)) return;
    return finish(reading_.get());
  }
  if (waiting_.empty()) return;
  begin(std::exchange(waiting_.front(), {}));
  waiting_.pop_front();
}

void ExhibitDesk::begin(ExhibitOrder order) {
  log::info(fmt::format("asked to {} exhibit {}{}", word_of_verb(order.verb), order.exhibit, order.now ? " now" : ""));
  auto file = file_of_order(order, scenarios_, folder_);
  if (!file) return answer(order, tl::unexpected(file.error()));
  if (order.verb == ExhibitVerb::retire) {
    scenarios_.retire(order.exhibit);
    note_change();
    if (order.now) lobby_.hurry(order.exhibit);
    return answer(order, {});
  }
  if (!transport_.has_room_for(order.exhibit)) {
    return answer(order, fail(ErrorCode::too_large, "this server has had too many exhibits in its life", order.exhibit,
                              "start it again with the exhibits that it shall have"));
  }
  file_ = std::move(*file);
  preparing_ = std::move(order);
  reading_ = reader_.ask([file = file_, settings = settings_] { return load_scenario(file, settings); });
}

Expected<void> ExhibitDesk::check(const Read& read, const std::string& wanted) const {
  if (!read) return tl::unexpected(read.error());
  const std::string& id = (*read)->id;
  if (id == wanted) return {};
  return fail(ErrorCode::conflict, fmt::format("the exhibit's file has the id '{}'", id), file_.string(),
              fmt::format("write the id '{}' in it, or name the file after its id", wanted));
}

void ExhibitDesk::finish(Read read) {
  const ExhibitOrder order = std::move(*preparing_);
  preparing_.reset();
  const Expected<void> done = check(read, order.exhibit);
  const auto former = scenarios_.find(order.exhibit);
  const bool changed = done && (former == nullptr || former->content_hash != (*read)->content_hash);
  if (changed) {
    scenarios_.put(std::move(*read), file_);
    note_change();
  }
  if (done && order.now) lobby_.hurry(order.exhibit);  // visits on a former content, too, where the file is as it was
  answer(order, done);
}

/// Tells the network which exhibits there are now, and keeps it for the next start.
void ExhibitDesk::note_change() {
  transport_.set_scenarios(scenarios_.ids());
  next_listing_ = {};
  const std::filesystem::path file = settings_.exhibit_changes_file();
  if (file.empty()) return;
  if (auto kept = write_changes(file, changes_since(of_settings_, scenarios_)); !kept)
    log::warning("a restarted server will not have this change: " + kept.error().to_string());
}

void ExhibitDesk::answer(const ExhibitOrder& order, const Expected<void>& done) {
  transport::ExhibitAnswer answer{.id = order.id, .refusal = {}, .place = {}, .remedy = {}};
  const std::string what = fmt::format("{} exhibit {}", word_of_verb(order.verb), order.exhibit);
  if (done) {
    log::info(what + ": done");
  } else {
    answer.refusal = done.error().what;
    answer.place = done.error().where;
    answer.remedy = done.error().remedy;
    log::warning(what + " was refused: " + done.error().to_string());
  }
  answers_.push_back(std::move(answer));
  if (answers_.size() > kMostAnswers) answers_.erase(answers_.begin());
}

void ExhibitDesk::publish(TimePoint now) {
  if (now >= next_listing_) {
    next_listing_ = now + kListEvery;
    loadable_ = exhibits_in(folder_);
    std::erase_if(loadable_, [this](const std::string& name) { return scenarios_.find(name) != nullptr; });
  }
  transport::ExhibitStatusData data;
  if (preparing_) data.preparing = preparing_->exhibit;
  data.loadable = loadable_;
  data.answers = answers_;
  for (const auto& scenario : scenarios_.all()) {
    const Lobby::WorldCount worlds = lobby_.worlds_of(scenario->id);
    data.exhibits.push_back({scenario->id, scenario->content_hash, scenario->title, worlds.current, worlds.former});
  }
  transport_.publish_exhibits(std::move(data));
}

}  // namespace mechane::app
