#include "server/app/settings.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <toml++/toml.h>

#include "server/app/version.hpp"

namespace mechane::app {
namespace {

/// Every key that a file may hold, by table. A key that is not here is an error: a misspelt limit must not be ignored.
class TomlReader {
 public:
  explicit TomlReader(std::string file) : file_(std::move(file)) {}

  Expected<void> read(Settings& settings) {
    toml::table table;
    try {
      table = toml::parse_file(file_);
    } catch (const toml::parse_error& e) {
      return fail(std::string(e.description()), fmt::format("{}:{}", file_, e.source().begin.line), "correct the line");
    }
    root_ = &table;
    take("name", settings.name);
    take("worlds", settings.worlds);
    take("loop_threads", settings.loop_threads);
    take("domain", settings.domain);
    take_path("records", settings.records);
    take("records_limit_mb", settings.records_limit_mb);
    take_path("visits", settings.visits);
    take("visits_keep_days", settings.visits_keep_days);
    take("visits_limit_mb", settings.visits_limit_mb);
    take_path("cache", settings.cache);
    take_path("catalogue", settings.catalogue);
    take("fifo_priority", settings.fifo_priority);
    take("world_idle_s", settings.world_idle_s);
    take("resume_within_s", settings.resume_within_s);
    take("verbose", settings.verbose);
    take_cpu(settings);
    take_scenarios(settings);
    take("force.max_force_n", settings.force.governor.max_force_n);
    take("force.max_torque_nm", settings.force.governor.max_torque_nm);
    take("force.max_slew_n_per_s", settings.force.governor.max_slew_n_per_s);
    take("force.stiffness_scale", settings.stiffness_scale);
    take_mode(settings);
    take_hand(settings.hand);
    return finish(table, "");
  }

 private:
  template <class T>
  void take(const std::string& key, T& out) {
    known_.push_back(key);
    const auto node = root_->at_path(key);
    if (!node) return;
    if (const auto value = node.value<T>()) {
      out = *value;
    } else if (error_.empty()) {
      error_ = fmt::format("'{}' is of the wrong kind", key);
      line_ = node.node()->source().begin.line;
    }
  }
  void take_path(const std::string& key, std::filesystem::path& out) {
    std::string text = out.string();
    take(key, text);
    out = text;
  }
  void take_cpu(Settings& settings) {
    int cpu = settings.first_cpu.value_or(-1);
    take("first_cpu", cpu);
    if (cpu >= 0) settings.first_cpu = cpu;
  }
  void take_scenarios(Settings& settings) {
    known_.emplace_back("scenarios");
    const auto* list = root_->at_path("scenarios").as_array();
    if (list == nullptr) return;
    for (const auto& entry : *list) {
      if (const auto path = entry.value<std::string>()) settings.scenarios.emplace_back(*path);
    }
  }
  void take_mode(Settings& settings) {
    std::string mode = settings.force.mode == haptics::ForceMode::paper ? "paper" : "continuous";
    take("force.mode", mode);
    if (mode != "paper" && mode != "continuous" && error_.empty()) error_ = "force.mode is 'continuous' or 'paper'";
    settings.force.mode = mode == "paper" ? haptics::ForceMode::paper : haptics::ForceMode::continuous;
  }
  /// One factor for the whole hand, and the palm's own sizes: what a technician calibrates.
  void take_hand(haptics::HandSize& hand) {
    take("hand.palm_half_length_m", hand.palm_half_m.x());
    take("hand.palm_half_thickness_m", hand.palm_half_m.y());
    take("hand.palm_half_breadth_m", hand.palm_half_m.z());
    take("hand.tip_radius_m", hand.tip_radius_m);
    static constexpr std::array<const char*, 5> kNames{"thumb", "index", "middle", "ring", "little"};
    for (std::size_t f = 0; f < hand.fingers.size(); ++f) {
      double length = 1;
      double breadth = 1;
      take(fmt::format("hand.{}_length_factor", kNames[f]), length);
      take(fmt::format("hand.{}_breadth_factor", kNames[f]), breadth);
      for (std::size_t k = 0; k < 3; ++k) {
        hand.fingers[f].length_m[k] *= length;
        hand.fingers[f].radius_m[k] *= breadth;
      }
    }
  }
  Expected<void> finish(const toml::table& table, const std::string& prefix) {
    if (!error_.empty())
      return fail(error_, fmt::format("{}:{}", file_, line_), "see server/app/README.md, 'Settings'");
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      if (const auto* inner = node.as_table()) {
        if (auto ok = finish(*inner, name + "."); !ok) return ok;
      } else if (std::find(known_.begin(), known_.end(), name) == known_.end()) {
        return fail(fmt::format("unknown setting '{}'", name), fmt::format("{}:{}", file_, node.source().begin.line),
                    "remove it or correct its name");
      }
    }
    return {};
  }

  std::string file_;
  const toml::table* root_ = nullptr;
  std::vector<std::string> known_;
  std::string error_;
  std::uint32_t line_ = 0;
};

Expected<void> validate(const Settings& s) {
  const auto range = [](const char* name, double value, double low, double high) -> Expected<void> {
    if (value >= low && value <= high) return {};
    return fail(fmt::format("{} is {}", name, value), "settings", fmt::format("give a value from {} to {}", low, high));
  };
  for (auto& checked :
       {range("worlds", s.worlds, 1, 64), range("loop_threads", s.loop_threads, 1, 32),
        range("domain", s.domain, 0, 230), range("fifo_priority", s.fifo_priority, 0, 98),
        range("world_idle_s", s.world_idle_s, 1, 86400), range("resume_within_s", s.resume_within_s, 0, 1e7),
        range("visits_keep_days", s.visits_keep_days, 0, 36500),
        range("visits_limit_mb", static_cast<double>(s.visits_limit_mb), 1, 1e6),
        range("force.stiffness_scale", s.stiffness_scale, 0, 10)}) {
    if (!checked) return checked;
  }
  if (auto governor = hand::ForceGovernor::make(s.force.governor); !governor)
    return fail(governor.error().what, "settings, [force]", governor.error().remedy);
  if (s.scenarios.empty()) {
    return fail("no scenario is given", "settings",
                "name at least one: --scenario scenarios/archimedes-screw/archimedes-screw.x3d");
  }
  if (s.name.empty() || s.name.size() > 31)
    return fail("the server's name must have 1 to 31 characters", "settings", "--name server-1");
  return {};
}

/// Writes the flags over `s`. `file` gets what --settings names, if it was given.
Expected<void> read_flags(int argc, const char* const* argv, Settings& s, std::optional<std::string>& file,
                          std::string& help) {
  CLI::App app{"The Mechane server: simulates worlds at 1 kHz and publishes them over DDS."};
  app.set_version_flag("--version", std::string("mechane ") + kVersion);
  std::vector<std::filesystem::path> scenarios;
  int cpu = -1;
  bool paper = false;
  app.add_option("--settings", file, "TOML file; flags win over it");
  app.add_option(
      "--scenario", scenarios,
      "X3D file of an exhibit, or its id in the catalogue; may be given several times, the first is the default");
  app.add_option("--catalogue", s.catalogue,
                 "catalogue (mechane content) that files are held against, and ids are found in");
  app.add_option("--name", s.name, "name on the wire and in logs");
  app.add_option("--worlds", s.worlds, "how many worlds may run at once");
  app.add_option("--loop-threads", s.loop_threads, "threads that the worlds are spread over");
  app.add_option("--domain", s.domain, "DDS domain");
  app.add_option("--records", s.records, "folder of journals and snapshots; '' keeps none");
  app.add_option("--records-limit-mb", s.records_limit_mb, "the oldest journals go when there are more");
  app.add_option(
      "--visits", s.visits,
      "file of visitors' sheets (mechane visits); a bare name lies in the folder of records; 'none' keeps none");
  app.add_option("--visits-keep-days", s.visits_keep_days, "older sheets are deleted; 0: never for their age");
  app.add_option("--visits-limit-mb", s.visits_limit_mb, "the oldest sheets go when the file is larger");
  app.add_option("--cache", s.cache, "folder of built collision parts");
  app.add_option("--fifo-priority", s.fifo_priority, "of the loop; 0: an ordinary thread");
  app.add_option("--first-cpu", cpu, "pin loop thread i to processor first + i");
  app.add_option("--world-idle", s.world_idle_s, "seconds after which a world without clients is closed");
  app.add_option("--resume-within", s.resume_within_s,
                 "seconds for which a restarted server puts a kiosk back at its step");
  app.add_option("--run-for", s.run_for_s, "stop after so many seconds; 0: run until told to stop");
  app.add_option("--report", s.report, "write counters and tick times to this JSON file at the stop");
  app.add_option("--max-force", s.force.governor.max_force_n, "newtons that the server asks of a device at most");
  app.add_option("--stiffness-scale", s.stiffness_scale, "factor on every stiffness; 0 turns touch off");
  app.add_flag("--paper-force", paper, "average force over the whole hand, as published, for comparison");
  app.add_flag("--verbose", s.verbose, "log details");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success&) {
    help = app.count("--version") > 0 ? app.version() + "\n" : app.help();
    return {};
  } catch (const CLI::ParseError& e) {
    return fail(e.what(), "command line", "see mechane server --help");
  }
  if (!scenarios.empty()) s.scenarios = scenarios;
  if (cpu >= 0) s.first_cpu = cpu;
  if (paper) s.force.mode = haptics::ForceMode::paper;
  return {};
}

}  // namespace

Expected<Settings> read_settings(int argc, const char* const* argv, std::string& help) {
  // The flags are read twice: to learn which file is meant, and then over what it says.
  std::optional<std::string> file;
  Settings from_flags;
  if (auto read = read_flags(argc, argv, from_flags, file, help); !read) return tl::unexpected(read.error());
  if (!help.empty()) return from_flags;
  Settings s;
  if (file) {
    if (auto read = TomlReader(*file).read(s); !read) return tl::unexpected(read.error());
  }
  if (auto read = read_flags(argc, argv, s, file, help); !read) return tl::unexpected(read.error());
  if (auto ok = validate(s); !ok) return tl::unexpected(ok.error());
  return s;
}

std::filesystem::path Settings::visits_file() const {
  if (visits.empty() || visits == "none") return {};
  if (visits.has_parent_path()) return visits;
  return records.empty() ? std::filesystem::path() : records / visits;
}

std::string to_string(const Settings& s) {
  std::string scenarios;
  for (const auto& path : s.scenarios)
    scenarios += (scenarios.empty() ? "" : ", ") + path.string();
  return fmt::format(
      "name = {}\nscenarios = {}\nworlds = {}\nloop_threads = {}\ndomain = {}\nrecords = {}\nrecords_limit_mb = {}\n"
      "visits = {}\nvisits_keep_days = {}\nvisits_limit_mb = {}\n"
      "cache = {}\ncatalogue = {}\nfifo_priority = {}\nfirst_cpu = {}\nworld_idle_s = {}\nresume_within_s = "
      "{}\nforce.mode = {}\n"
      "force.max_force_n = {}\nforce.stiffness_scale = {}",
      s.name, scenarios, s.worlds, s.loop_threads, s.domain, s.records.empty() ? "none" : s.records.string(),
      s.records_limit_mb, s.visits_file().empty() ? "none" : s.visits_file().string(), s.visits_keep_days,
      s.visits_limit_mb, s.cache.empty() ? "the user's cache folder" : s.cache.string(),
      s.catalogue.empty() ? "none" : s.catalogue.string(), s.fifo_priority,
      s.first_cpu ? std::to_string(*s.first_cpu) : "any", s.world_idle_s, s.resume_within_s,
      s.force.mode == haptics::ForceMode::paper ? "paper" : "continuous", s.force.governor.max_force_n,
      s.stiffness_scale);
}

}  // namespace mechane::app
