// `mechane`: one command for people. Short tasks run here; long-running programs take its place.
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "client-sdk/authoring/merge.hpp"
#include "client-sdk/authoring/reference.hpp"
#include "client-sdk/cli/content.hpp"
#include "client-sdk/cli/displays.hpp"
#include "client-sdk/cli/doctor.hpp"
#include "client-sdk/cli/echo.hpp"
#include "client-sdk/cli/exhibits.hpp"
#include "client-sdk/cli/head.hpp"
#include "client-sdk/cli/open.hpp"
#include "client-sdk/cli/record.hpp"
#include "client-sdk/cli/sibling.hpp"
#include "client-sdk/cli/studio.hpp"
#include "client-sdk/cli/visits.hpp"
#include "server/base/suggestion.hpp"
#include "server/log/command_line.hpp"
#include "server/log/log.hpp"
#include "server/scenario/checker.hpp"
#include "server/x3d/problem.hpp"
#include <mechane/client/displays.hpp>

namespace {

using namespace mechane;

struct Program {
  std::string_view command;
  std::string_view summary;
};

/// Commands that are programs of their own: `mechane server` runs mechane-server.
constexpr std::array<Program, 8> kPrograms{{
    {"server", "run worlds and publish them"},
    {"display", "show a world, in a window or to pictures"},
    {"haptic", "run a haptic device, real or virtual"},
    {"devices", "list the drivers of haptic devices, and try a device"},
    {"visitor", "play a scenario's visit like a person"},
    {"gateway", "show kiosks and the operator's console to web browsers"},
    {"fit", "make meshes ready for touch, and report how accurately they feel"},
    {"replay", "run a journal again and compare its state hashes"},
}};

CLI::App* add_echo(CLI::App& app, cli::EchoOptions& echo) {
  CLI::App* command = app.add_subcommand("echo", "print what goes over the wire");
  command->add_option("topic", echo.topic, "topic, e.g. SceneFrame; without one: the list");
  command->add_option("--kiosk", echo.kiosk, "only this kiosk; for topics of a world: only its world");
  command->add_option("--world", echo.world, "only this world");
  command->add_option("--domain", echo.domain, "DDS domain");
  command->add_option("--count", echo.count, "stop after this many samples; 0: until interrupted");
  command->add_option("--seconds", echo.seconds,
                      "stop after this time, with status 1 if nothing was received; 0: until interrupted");
  command->add_flag("--json", echo.json, "one JSON object a line");
  return command;
}

CLI::App* add_open(CLI::App& app, cli::OpenOptions& open) {
  CLI::App* command = app.add_subcommand("open", "let a kiosk go on to another exhibit, or home");
  command->add_option("scenario", open.scenario, "id of the scenario; without: home, the server's first");
  command->add_option("--kiosk", open.kiosk, "name of the kiosk")
      ->capture_default_str()
      ->check([](const std::string& name) {
        return name.empty() ? "the kiosk's name is empty: write --kiosk kiosk-1" : std::string();
      });
  command->add_option("--domain", open.domain, "DDS domain");
  return command;
}

CLI::App* add_record(CLI::App& app, cli::RecordOptions& o) {
  CLI::App* record =
      app.add_subcommand("record", "record what a kiosk's displays hear, to be shown with mechane display --play");
  record->add_option("file", o.file, "the recording; an existing file is overwritten")->required();
  record->add_option("--kiosk", o.kiosk, "name of the kiosk")->capture_default_str();
  record->add_option("--domain", o.domain, "DDS domain");
  record->add_option("--seconds", o.seconds, "stop after this time; 0: on Ctrl-C")->check(CLI::NonNegativeNumber);
  record->add_option("--record-fps", o.recorder.fps, "frames per second to record, at most")
      ->check(CLI::Range(1.0, 240.0))
      ->capture_default_str();
  record
      ->add_option_function<std::uint64_t>(
          "--record-mib", [&o](std::uint64_t mib) { o.recorder.limit_bytes = mib << 20U; },
          "size in MiB at which the recording ends; without: 256")
      ->check(CLI::Range(1, 1024));
  return record;
}

CLI::App* add_exhibits(CLI::App& app, cli::ExhibitsOptions& o) {
  CLI::App* exhibits =
      app.add_subcommand("exhibits", "list a running server's exhibits; load, replace and retire them");
  exhibits->require_subcommand(0, 1);
  exhibits->add_option("--server", o.server, "name of the server; without: the first that is heard");
  exhibits->add_option("--key", o.key, "the server's key file, which only its user can read, or a copy of it")
      ->capture_default_str();
  exhibits->add_option("--domain", o.domain, "DDS domain");
  exhibits->add_option("--seconds", o.seconds, "how long the server may take: fitting new parts takes minutes")
      ->check(CLI::Range(0.1, 7200.0))
      ->capture_default_str();
  exhibits->add_flag("--json", o.json, "the list as JSON");
  exhibits->add_flag("--now", o.now, "visits in progress do not finish: their forces go to zero, and they end");
  CLI::App* list = exhibits->add_subcommand("list", "what there is, how many worlds run it, and what could be loaded");
  CLI::App* load = exhibits->add_subcommand("load", "load an exhibit of the server's folder");
  CLI::App* replace =
      exhibits->add_subcommand("replace", "read an exhibit's file anew; visits in progress finish as they began");
  CLI::App* retire = exhibits->add_subcommand("retire", "take an exhibit out; visits in progress finish");
  for (CLI::App* command : {load, replace, retire})
    command->add_option("name", o.name, "id of the exhibit")->required();
  for (CLI::App* command : {list, load, replace, retire})
    command->fallthrough();  // options may follow the verb
  return exhibits;
}

CLI::App* add_displays(CLI::App& app, cli::DisplaysOptions& o) {
  CLI::App* displays =
      app.add_subcommand("displays", "show the state of all displays, with remarks; change their settings");
  displays->require_subcommand(0, 1);
  displays->add_option("--kiosk", o.kiosk, "only this kiosk's");
  displays->add_option("--display", o.display, "only the display of this name (mechane display --name)");
  displays->add_option("--domain", o.domain, "DDS domain");
  displays->add_option("--seconds", o.seconds, "how long displays may take to answer")
      ->check(CLI::Range(0.1, 600.0))
      ->capture_default_str();
  displays->add_flag("--json", o.json, "one JSON object a line");
  std::string help = "change settings of a kiosk's displays, until they are restarted:";
  for (const client::DisplaySettingInfo& setting : client::display_settings())
    help += " " + std::string(setting.name) + " (" + std::string(setting.values) + ")";
  CLI::App* set = displays->add_subcommand("set", help);
  set->add_option("settings", o.settings, "NAME=VALUE, as in volume=0.5 language=en")->required();
  CLI::App* picture =
      displays->add_subcommand("picture", "let a kiosk's displays write what they show into their --out folder");
  CLI::App* restart = displays->add_subcommand(
      "restart", "let a kiosk's displays end; the service of each starts it again (mechane-display@.service)");
  for (CLI::App* command : {set, picture, restart})
    command->fallthrough();  // --kiosk may follow the verb
  return displays;
}

CLI::App* add_head(CLI::App& app, cli::HeadOptions& o) {
  CLI::App* head = app.add_subcommand(
      "head", "send the position of the visitor's head to a kiosk's displays, for a tracker, or to try it");
  head->add_option("--kiosk", o.kiosk, "whose displays")->capture_default_str();
  head->add_option("--display", o.display, "only the display of this name; without: all displays of the kiosk");
  head->add_option("--domain", o.domain, "DDS domain");
  head->add_option("--at", o.at,
                   "between the eyes, metres from the middle of the screen: right, up, towards the visitor")
      ->expected(3);
  head->add_option("--seconds", o.seconds, "with --at: how long it is sent; 0: until Ctrl-C")
      ->check(CLI::NonNegativeNumber);
  head->footer(
      "Without --at it reads lines from its standard input, one for each reading of the tracker: 'x y z', or 'x y z qw "
      "qx "
      "qy qz', or "
      "'nobody'.");
  return head;
}

void add_content_add(CLI::App& content, cli::ContentOptions& o) {
  CLI::App* add = content.add_subcommand(
      "add", "add or update files in the catalogue; for scenarios also the files that they need");
  add->add_option("files", o.words, "files and folders, in the catalogue's folder")->required();
  add->add_option("--licence", o.credits.licence,
                  "e.g. Apache-2.0; overrides what the file says, like the following options; if neither is given, a "
                  "file LICENCE or "
                  "LICENSE in its folder or above counts, with its lines SPDX-License-Identifier and "
                  "SPDX-FileCopyrightText");
  add->add_option("--author", o.credits.author, "who made it");
  add->add_option("--source", o.credits.source, "where it comes from, or what it is based on");
  add->add_option("--version", o.credits.version, "of the file");
  add->add_option("--tag", o.tags, "a word to find it by; may be given several times");
  add->add_option("--language", o.languages, "a language that it is in; may be given several times");
}

CLI::App* add_content(CLI::App& app, cli::ContentOptions& o) {
  CLI::App* content = app.add_subcommand("content", "manage the catalogue of scenarios, models, sounds and texts");
  content->require_subcommand(1);
  content->add_option("--catalogue", o.catalogue, "the catalogue's file, beside what it describes")
      ->capture_default_str();
  add_content_add(*content, o);
  CLI::App* list = content->add_subcommand("list", "print the catalogue's entries");
  list->add_option("--kind", o.kind, "only scenario, model, part, texture, sound or text");
  list->add_option("--tag", o.tag, "only what has this tag");
  list->add_option("--language", o.language, "only what is in this language");
  CLI::App* show = content->add_subcommand("show", "print all that is known of a file");
  show->add_option("names", o.words, "name, path, or hash (its first six digits are enough)")->required();
  CLI::App* verify = content->add_subcommand(
      "verify", "report changed and missing files, missing languages, orphans; status 1 if there are any");
  content->add_subcommand("remove", "remove files from the catalogue; the files themselves stay")
      ->add_option("names", o.words, "name, path, or hash")
      ->required();
  CLI::App* out = content->add_subcommand(
      "export", "copy content, all files that it refers to, and a catalogue of them, for a kiosk");
  out->add_option("folder", o.folder, "a new or empty folder, or one with an older export")->required();
  out->add_option("names", o.words,
                  "only these and the files that they refer to: models, sounds, pages, the scenarios that signs open; "
                  "without: all");
  for (CLI::App* command : {list, show, verify})
    command->add_flag("--json", o.json, "as JSON");
  for (CLI::App* command : content->get_subcommands({}))
    command->fallthrough();  // --catalogue may follow the verb
  return content;
}

CLI::App* add_visits(CLI::App& app, cli::VisitsOptions& o) {
  CLI::App* visits = app.add_subcommand("visits", "report what visitors did and answered: tables, CSV, a plot");
  visits->require_subcommand(0, 1);
  visits->add_option("--records", o.records, "the server's folder of records, with the file of visits")
      ->capture_default_str();
  visits->add_option("--file", o.file, "or the file of visits itself");
  visits->add_option("--remarks", o.remarks, "with the remarks of a console: remarks.json in its gateway's folder");
  visits->add_option("--since", o.since, "only visits that began then or later: 2026-11-22, or with a time, in UTC");
  visits->add_option("--scenario", o.scenario, "only visits to this scenario (its id)");
  visits->add_option("--kiosk", o.kiosk, "only visits at this kiosk");
  visits->add_option("--csv", o.csv, "write single visits to this file, for a spreadsheet");
  visits->add_option("--svg", o.svg, "draw the report to this file");
  CLI::App* list = visits->add_subcommand("list", "print the newest visits, with their numbers");
  list->add_option("--last", o.last, "how many; 0: all")->capture_default_str();
  CLI::App* show = visits->add_subcommand("show", "print all of one visit's record");
  CLI::App* remark = visits->add_subcommand("remark", "add an observer's remark to a visit's record");
  CLI::App* forget = visits->add_subcommand("forget", "delete the records of one visit, or of all before a date");
  for (CLI::App* command : {show, remark})
    command->add_option("visit", o.visit, "its number; the first four letters may do")->required();
  remark->add_option("text", o.text, "up to 2000 bytes; name nobody in it")->required();
  forget->add_option("visit", o.visit, "its number; the first four letters may do");
  forget->add_option("--before", o.before, "all that began before this date");
  for (CLI::App* command : {visits, list, show})
    command->add_flag("--json", o.json, "as JSON");
  for (CLI::App* command : visits->get_subcommands({}))
    command->fallthrough();  // --records may follow the verb
  return visits;
}

CLI::App* add_merge(CLI::App& app, std::vector<std::string>& files, std::string& output) {
  CLI::App* merge = app.add_subcommand("merge", "combine several scenarios into one file, and rename names that clash");
  merge->add_option("files", files, "X3D files, two or more")->required();
  merge->add_option("-o,--output", output, "the file to write")->required();
  return merge;
}

CLI::App* add_studio(CLI::App& app, std::string& file) {
  CLI::App* studio = app.add_subcommand("studio", "edit a scenario by commands, one JSON object a line, for scripts");
  studio->add_option("file", file, R"(the X3D file; it changes only on {"do": "save"})")->required();
  return studio;
}

void add_doctor(CLI::App& app, cli::DoctorOptions& o) {
  CLI::App* doctor = app.add_subcommand("doctor", "check whether this machine can hold 1 kHz and servers keep up");
  doctor->add_flag("--json", o.json, "as JSON");
  doctor->add_option("--domain", o.domain, "DDS domain in which to listen for servers");
  doctor->add_option("--probe-seconds", o.probe_s, "how long to measure wake-ups");
}

/// The message for a first word that is not a command; empty: it is a command, or an option.
std::string unknown_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(command->get_name());
  if (word.starts_with('-') || std::ranges::count(known, word) > 0) return {};
  const std::string near = nearest(word, known);
  return "mechane: there is no command '" + word.substr(0, 80) + "'" +
         (near.empty() ? "" : ": did you mean '" + near + "'?") + " (mechane --help lists them)\n";
}

int add_and_parse(int argc, char** argv) {
  CLI::App app{"Mechane: touch, assemble and work the machines of ancient Greek engineers.", "mechane"};
  app.set_version_flag("--version", std::string("mechane ") + MECHANE_VERSION);
  app.require_subcommand(1);
  for (const Program& program : kPrograms) {
    app.add_subcommand(std::string(program.command), std::string(program.summary) + " (--help tells more)");
  }
  cli::EchoOptions echo;
  auto* echo_command = add_echo(app, echo);
  cli::OpenOptions open;
  auto* open_command = add_open(app, open);
  cli::RecordOptions record;
  auto* record_command = add_record(app, record);
  cli::DisplaysOptions displays;
  auto* displays_command = add_displays(app, displays);
  cli::ExhibitsOptions exhibits;
  auto* exhibits_command = add_exhibits(app, exhibits);
  cli::HeadOptions head;
  auto* head_command = add_head(app, head);
  cli::ContentOptions content;
  auto* content_command = add_content(app, content);
  cli::VisitsOptions visits;
  auto* visits_command = add_visits(app, visits);
  std::vector<std::string> files;
  auto* check_command = app.add_subcommand("check", "check scenario files: errors with line, node and remedy");
  check_command->add_option("files", files, "X3D files")->required();
  bool check_json = false;
  check_command->add_flag("--json", check_json, "as JSON");
  std::vector<std::string> merge_files;
  std::string merged_file;
  auto* merge_command = add_merge(app, merge_files, merged_file);
  std::string studio_file;
  auto* studio_command = add_studio(app, studio_file);
  auto* reference_command = app.add_subcommand("reference", "print the manual of the scenario format, as Markdown");
  cli::DoctorOptions doctor;
  add_doctor(app, doctor);
  if (const std::string fault = argc > 1 ? unknown_command(app, argv[1]) : std::string(); !fault.empty()) {
    std::cerr << fault;
    return 2;
  }
  if (const std::optional<int> status = parse_command_line(app, argc, argv)) return *status;
  if (*echo_command) return cli::run_echo(echo);
  if (*open_command) return cli::run_open(open);
  if (*record_command) return cli::run_record(record, std::cerr);
  if (*displays_command) {
    const auto verbs = displays_command->get_subcommands();
    return cli::run_displays(verbs.empty() ? "" : verbs.front()->get_name(), displays);
  }
  if (*exhibits_command) {
    const auto verbs = exhibits_command->get_subcommands();
    return cli::run_exhibits(verbs.empty() ? "" : verbs.front()->get_name(), exhibits);
  }
  if (*head_command) return cli::run_head(head, std::cin, std::cerr);
  if (*content_command)
    return cli::run_content(content_command->get_subcommands().front()->get_name(), content, std::cout, std::cerr);
  if (*visits_command) {
    const auto verbs = visits_command->get_subcommands();
    return cli::run_visits(verbs.empty() ? "" : verbs.front()->get_name(), visits, std::cout, std::cerr);
  }
  if (*check_command)
    return scenario::run_check(files, std::cout,
                               check_json ? scenario::CheckFormat::json : scenario::CheckFormat::text);
  if (*merge_command) return authoring::run_merge(merge_files, merged_file, std::cout);
  if (*studio_command) return cli::run_studio(studio_file, std::cin, std::cout, std::cerr);
  if (*reference_command) {
    std::cout << authoring::reference_page();
    return 0;
  }
  return cli::run_doctor(doctor);
}

}  // namespace

int main(int argc, char** argv) {
  log::start("mechane", log::Level::info);
  if (argc > 1) {
    for (const Program& program : kPrograms) {
      if (program.command == argv[1]) return cli::become("mechane-" + std::string(argv[1]), {argv + 2, argv + argc});
    }
  }
  return add_and_parse(argc, argv);
}
