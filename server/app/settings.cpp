#include "server/app/settings.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <toml++/toml.h>

#include "server/app/version.hpp"
#include "server/log/command_line.hpp"
#include <mechane/proto/names.hpp>

namespace mechane::app {
namespace {

/// Reads the settings of a file. An unknown key is an error: a misspelt limit must not be ignored.
class TomlReader {
 public:
  explicit TomlReader(std::string file) : file_(std::move(file)) {}

  Expected<void> read(Settings& settings) {
    toml::table table;
    try {
      table = toml::parse_file(file_);
    } catch (const toml::parse_error& e) {
      // Where the file cannot be opened, there is no line.
      const auto line = static_cast<int>(e.source().begin.line);
      return line == 0
                 ? fail(ErrorCode::not_found, std::string(e.description()), file_, "check the file's path and rights")
                 : fail(ErrorCode::damaged, std::string(e.description()), at(line), "correct the line");
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
    take_path("exhibits", settings.exhibits);
    take_path("exhibit_key", settings.exhibit_key);
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
    } else {
      note_fault(fmt::format("'{}' has a value of the wrong type", key), *node.node());
    }
  }
  /// The first fault counts.
  void note_fault(std::string what, const toml::node& node) {
    if (!fault_.empty()) return;
    fault_ = std::move(what);
    fault_line_ = static_cast<int>(node.source().begin.line);
  }
  [[nodiscard]] Place at(int line) const { return {fmt::format("{}:{}", file_, line), line}; }
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
    if (mode != "paper" && mode != "continuous")
      note_fault(fmt::format("force.mode is '{}'; it must be 'continuous' or 'paper'", mode),
                 *root_->at_path("force.mode").node());
    settings.force.mode = mode == "paper" ? haptics::ForceMode::paper : haptics::ForceMode::continuous;
  }
  /// What a technician calibrates: sizes of the palm and the finger tips, and two factors for each finger.
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
    if (!fault_.empty())
      return fail(ErrorCode::invalid_value, fault_, at(fault_line_), "see server/app/README.md, 'Settings'");
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      if (const auto* inner = node.as_table()) {
        if (auto ok = finish(*inner, name + "."); !ok) return ok;
      } else if (std::find(known_.begin(), known_.end(), name) == known_.end()) {
        return fail(ErrorCode::unknown_name, fmt::format("unknown setting '{}'", name),
                    at(static_cast<int>(node.source().begin.line)), "remove it or correct its name");
      }
    }
    return {};
  }

  std::string file_;
  const toml::table* root_ = nullptr;
  std::vector<std::string> known_;
  std::string fault_;
  int fault_line_ = 0;
};

Expected<void> validate(const Settings& s) {
  const auto range = [](const char* name, double value, double low, double high) -> Expected<void> {
    if (value >= low && value <= high) return {};
    return fail(ErrorCode::invalid_value, fmt::format("{} is {}", name, value), "settings",
                fmt::format("give a value from {} to {}", low, high));
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
  if (auto governor = hand::ForceGovernor::make(s.force.governor); !governor) {
    Error error = governor.error();
    error.where = "settings, [force]";
    return tl::unexpected(std::move(error));
  }
  if (s.scenarios.empty()) {
    return fail(ErrorCode::missing, "no scenario is given", "settings",
                "name at least one: --scenario scenarios/archimedes-screw/archimedes-screw.x3d");
  }
  if (s.name.empty() || s.name.size() >= proto::kNameSize) {
    return fail(ErrorCode::invalid_value,
                fmt::format("the server's name must have 1 to {} characters", proto::kNameSize - 1), "settings",
                "give it a name such as --name server-1");
  }
  return {};
}

/// Writes the flags over `s`. `file` gets what --settings names, if it was given.
Expected<void> read_flags(int argc, const char* const* argv, Settings& s, std::optional<std::string>& file,
                          std::string& help) {
  CLI::App app{"The Mechane server: simulates worlds at 1 kHz and publishes them over DDS.", "mechane server"};
  app.set_version_flag("--version", std::string("mechane ") + kVersion);
  std::vector<std::filesystem::path> scenarios;
  int cpu = -1;
  bool paper = false;
  app.add_option("--settings", file, "TOML file; flags win over it");
  app.add_option(
      "--scenario", scenarios,
      "X3D file of an exhibit, or its id in the catalogue; may be given several times; kiosks begin in the first");
  app.add_option("--catalogue", s.catalogue,
                 "catalogue (mechane content) in which ids are looked up, and with which files are compared");
  app.add_option("--exhibits", s.exhibits,
                 "folder from which mechane exhibits loads by name; without: the one around the first scenario's");
  app.add_option(
      "--exhibit-key", s.exhibit_key,
      "key file of those who may change exhibits, made where it is missing; a name without folder lies in the "
      "folder of records; 'none': exhibits cannot be changed");
  app.add_option("--name", s.name, "name on the wire and in logs");
  app.add_option("--worlds", s.worlds, "how many worlds may run at once");
  app.add_option("--loop-threads", s.loop_threads, "threads that the worlds are spread over");
  app.add_option("--domain", s.domain, "DDS domain");
  app.add_option("--records", s.records, "folder of journals and snapshots; '': nothing is recorded");
  app.add_option("--records-limit-mb", s.records_limit_mb,
                 "the oldest journals are deleted when all together are larger");
  app.add_option("--visits", s.visits,
                 "file of the records of visits (mechane visits); a name without folder lies in the folder of records; "
                 "'none': visits "
                 "are not recorded");
  app.add_option("--visits-keep-days", s.visits_keep_days, "older visits are deleted; 0: age does not count");
  app.add_option("--visits-limit-mb", s.visits_limit_mb, "the oldest visits are deleted when the file is larger");
  app.add_option("--cache", s.cache, "folder of built collision parts");
  app.add_option("--fifo-priority", s.fifo_priority, "SCHED_FIFO priority of the loop threads; 0: ordinary threads");
  app.add_option("--first-cpu", cpu, "pin loop thread i to processor FIRST_CPU + i");
  app.add_option("--world-idle", s.world_idle_s, "seconds after which a world without clients is closed");
  app.add_option("--resume-within", s.resume_within_s,
                 "how many seconds after a stop a restarted server continues a kiosk at its step");
  app.add_option("--run-for", s.run_for_s, "stop after this many seconds; 0: run until told to stop");
  app.add_option("--report", s.report, "write counters and tick times to this JSON file at the stop");
  app.add_option("--max-force", s.force.governor.max_force_n,
                 "largest force that the server sends to a device, in newtons");
  app.add_option("--stiffness-scale", s.stiffness_scale,
                 "factor on the stiffness of all that is touched; 0 turns touch off");
  app.add_flag("--paper-force", paper,
               "average the force over the whole hand, as the published system did, for comparison");
  app.add_flag("--paced", s.paced,
               "read orders from standard input, 'pace X' (0 to 1 of real time), 'step N' (ticks) and 'edit N' (its "
               "file has been "
               "edited), and stop when it ends");
  app.add_flag("--verbose", s.verbose, "log details");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success&) {
    help = app.count("--version") > 0 ? app.version() + "\n" : app.help();
    return {};
  } catch (const CLI::ParseError& e) {
    return tl::unexpected(command_line_error(app, e));
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

std::filesystem::path Settings::exhibit_key_file() const {
  if (exhibit_key.empty() || exhibit_key == "none") return {};
  if (exhibit_key.has_parent_path()) return exhibit_key;
  return records.empty() ? std::filesystem::path() : records / exhibit_key;
}

std::filesystem::path Settings::exhibit_changes_file() const {
  return records.empty() ? std::filesystem::path() : records / "exhibits.json";
}

std::string to_string(const Settings& s) {
  std::string scenarios;
  for (const auto& path : s.scenarios)
    scenarios += (scenarios.empty() ? "" : ", ") + path.string();
  return fmt::format(
      "name = {}\nscenarios = {}\nworlds = {}\nloop_threads = {}\ndomain = {}\nrecords = {}\nrecords_limit_mb = {}\n"
      "visits = {}\nvisits_keep_days = {}\nvisits_limit_mb = {}\n"
      "cache = {}\ncatalogue = {}\nexhibits = {}\nexhibit_key = {}\nfifo_priority = {}\nfirst_cpu = {}\nworld_idle_s = "
      "{}\nresume_within_s = "
      "{}\nforce.mode = {}\n"
      "force.max_force_n = {}\nforce.stiffness_scale = {}",
      s.name, scenarios, s.worlds, s.loop_threads, s.domain, s.records.empty() ? "none" : s.records.string(),
      s.records_limit_mb, s.visits_file().empty() ? "none" : s.visits_file().string(), s.visits_keep_days,
      s.visits_limit_mb, s.cache.empty() ? "the user's cache folder" : s.cache.string(),
      s.catalogue.empty() ? "none" : s.catalogue.string(),
      s.exhibits.empty() ? "around the first scenario's folder" : s.exhibits.string(),
      s.exhibit_key_file().empty() ? "none" : s.exhibit_key_file().string(), s.fifo_priority,
      s.first_cpu ? std::to_string(*s.first_cpu) : "any", s.world_idle_s, s.resume_within_s,
      s.force.mode == haptics::ForceMode::paper ? "paper" : "continuous", s.force.governor.max_force_n,
      s.stiffness_scale);
}

}  // namespace mechane::app
