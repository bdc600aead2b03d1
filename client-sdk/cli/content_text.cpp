#include "client-sdk/cli/content_text.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "client-sdk/cli/columns.hpp"
#include "server/base/utf8.hpp"
#include "server/content/content_hash.hpp"

namespace mechane::cli {
namespace {

using content::CatalogueEntry;
using content::CatalogueFault;
using Json = nlohmann::ordered_json;

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string total(std::span<const CatalogueEntry> entries) {
  std::uint64_t bytes = 0;
  for (const CatalogueEntry& entry : entries)
    bytes += entry.bytes;
  return fmt::format("{}, {}", count_text(entries.size(), "file", "files"), size_text(bytes));
}

/// The texts that are missing in a language of the entry: one line each, the first with the language.
void write_lacking(const CatalogueEntry& entry, std::string& page) {
  for (const std::string& language : entry.languages) {
    std::string head = "lacks in " + shown(language);
    for (const auto& [words, said] : entry.wordings) {
      if (std::ranges::find(said, language) == said.end())
        page += fmt::format("  {:<11} {}\n", std::exchange(head, ""), shown(words));
    }
  }
}

}  // namespace

std::string shown(const std::string& text) {
  return without_controls(text);
}

std::string or_dash(const std::string& text) {
  return text.empty() ? "-" : shown(text);
}

std::string count_text(std::size_t number, const char* one, const char* more) {
  return fmt::format("{} {}", number, number == 1 ? one : more);
}

std::string size_text(std::uint64_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  const double kb = static_cast<double>(bytes) / 1000;
  return kb < 1000 ? fmt::format("{:.0f} KB", kb) : fmt::format("{:.1f} MB", kb / 1000);
}

std::string entries_table(std::span<const CatalogueEntry> entries) {
  Columns table({"kind", "name", "languages", "licence", "version", "size", "hash", "path"}, "<<<<<><");
  for (const CatalogueEntry& e : entries) {
    table.add({std::string(word_of(e.kind)), or_dash(e.name), or_dash(fmt::format("{}", fmt::join(e.languages, " "))),
               or_dash(e.credits.licence), or_dash(e.credits.version), size_text(e.bytes), content::short_hash(e.hash),
               shown(e.path)});
  }
  return (table.is_empty() ? "" : table.text()) + total(entries) + "\n";
}

std::string entry_page(const CatalogueEntry& entry, std::span<const CatalogueEntry> all) {
  std::string page = fmt::format("{} ({})\n", shown(entry.name), word_of(entry.kind));
  const auto line = [&](const std::string& what, const std::string& text) {
    page += fmt::format("  {:<11} {}\n", what, or_dash(text));
  };
  for (const auto& [language, words] : entry.titles)
    line("title " + shown(language), words);
  line("file", fmt::format("{}, {}", entry.path, size_text(entry.bytes)));
  line("hash", entry.hash);
  line("languages", fmt::format("{}", fmt::join(entry.languages, " ")));
  line("licence", entry.credits.licence);
  line("author", entry.credits.author);
  line("source", entry.credits.source);
  line("version", entry.credits.version);
  line("tags", fmt::format("{}", fmt::join(entry.tags, ", ")));
  std::vector<std::string> users;
  for (const CatalogueEntry& other : all) {
    if (std::ranges::find(other.refers_to, entry.path) != other.refers_to.end()) users.push_back(other.path);
  }
  line("refers to", fmt::format("{}", fmt::join(entry.refers_to, ", ")));
  line("used by", fmt::format("{}", fmt::join(users, ", ")));
  if (!entry.wordings.empty()) line("words", count_text(entry.wordings.size(), "text", "texts") + " to read or hear");
  write_lacking(entry, page);
  return page;
}

std::string entries_json(std::span<const CatalogueEntry> entries) {
  Json list = Json::array();
  for (const CatalogueEntry& e : entries) {
    list.push_back({{"path", e.path},
                    {"kind", word_of(e.kind)},
                    {"name", e.name},
                    {"hash", e.hash},
                    {"bytes", e.bytes},
                    {"licence", e.credits.licence},
                    {"source", e.credits.source},
                    {"author", e.credits.author},
                    {"version", e.credits.version},
                    {"titles", e.titles},
                    {"languages", e.languages},
                    {"tags", e.tags},
                    {"refers_to", e.refers_to},
                    {"wordings", e.wordings}});
  }
  return dump(list);
}

std::string faults_text(std::span<const CatalogueFault> faults, std::span<const CatalogueEntry> entries) {
  std::string text;
  std::vector<const CatalogueFault*> notes;
  std::size_t errors = 0;
  for (const CatalogueFault& fault : faults) {
    if (fault.is_note()) {
      notes.push_back(&fault);
      continue;
    }
    ++errors;
    text +=
        fmt::format("{}: {}: {}; {}\n", shown(fault.path), word_of(fault.kind), shown(fault.what), shown(fault.remedy));
  }
  if (notes.size() == 1) {
    text += fmt::format("{}: note: {}; {}\n", shown(notes[0]->path), notes[0]->what, notes[0]->remedy);
  } else if (!notes.empty()) {
    text += fmt::format("note: {} files have no licence, {} the first; {}\n", notes.size(), shown(notes[0]->path),
                        notes[0]->remedy);
  }
  const std::string verdict = errors == 0 ? "all as recorded in the catalogue" : count_text(errors, "fault", "faults");
  return text + fmt::format("{}: {}\n", total(entries), verdict);
}

std::string faults_json(std::span<const CatalogueFault> faults) {
  Json list = Json::array();
  for (const CatalogueFault& fault : faults) {
    list.push_back({{"kind", word_of(fault.kind)},
                    {"severity", fault.is_note() ? "note" : "error"},
                    {"path", fault.path},
                    {"what", fault.what},
                    {"remedy", fault.remedy}});
  }
  return dump(list);
}

}  // namespace mechane::cli
