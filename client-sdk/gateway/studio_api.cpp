#include "client-sdk/gateway/studio_api.hpp"

#include <charconv>
#include <chrono>
#include <optional>
#include <span>

#include "client-sdk/gateway/drafts/studio_scene.hpp"
#include "client-sdk/gateway/preview_api.hpp"
#include "client-sdk/studio/draft/archive.hpp"
#include "client-sdk/studio/view/schema_json.hpp"
#include "server/base/utf8.hpp"

namespace mechane::gateway {
namespace {

using studio::Author;
using studio::Shelf;

constexpr std::string_view kStudio = "/api/studio/";
constexpr std::string_view kDrafts = "/api/studio/drafts/";
constexpr std::string_view kFiles = "files/";
constexpr std::string_view kDelete = "/delete";
constexpr std::string_view kImport = "import";
constexpr std::string_view kPicture = "picture";
constexpr std::string_view kCatalogue = "/api/studio/catalogue";
constexpr std::string_view kAbout = "/api/studio/catalogue/about";
constexpr std::size_t kLongestPath = 500;
constexpr std::size_t kLongestDraftName = 64;

/// An address below a draft: "odometer", "versions/3/restore".
struct DraftPath {
  std::string name;
  std::string verb;
};

std::optional<DraftPath> draft_path(const std::string& path) {
  if (!path.starts_with(kDrafts)) return std::nullopt;
  const std::string rest = path.substr(kDrafts.size());
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  return DraftPath{rest.substr(0, slash), rest.substr(std::min(slash + 1, rest.size()))};
}

/// Of "versions/3/restore".
std::optional<std::int64_t> restored_version(std::string_view verb) {
  constexpr std::string_view kHead = "versions/", kTail = "/restore";
  if (!verb.starts_with(kHead) || !verb.ends_with(kTail) || verb.size() <= kHead.size() + kTail.size())
    return std::nullopt;
  const std::string_view digits = verb.substr(kHead.size(), verb.size() - kHead.size() - kTail.size());
  std::int64_t number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (read.ec != std::errc() || read.ptr != digits.data() + digits.size() || number < 1) return std::nullopt;
  return number;
}

/// Of "files/arm.glb/delete"; empty: it is another one.
std::string deleted_file(const std::string& verb) {
  if (!verb.starts_with(kFiles) || !verb.ends_with(kDelete) || verb.size() < kFiles.size() + kDelete.size()) return {};
  return verb.substr(kFiles.size(), verb.size() - kFiles.size() - kDelete.size());
}

unsigned status_of(const studio::ShelfFault& fault) {
  if (fault.stale) return 409;
  if (fault.command || !fault.problems.empty()) return 422;
  return refusal(fault.error).status;
}

HttpAnswer answer_of(const studio::ShelfResult<std::string>& result) {
  return result ? fresh_answer(*result) : fault_answer(result.error());
}

/// Bytes that a browser keeps as a file.
HttpAnswer file_answer(const std::string& file, const char* type, studio::ShelfResult<std::string> bytes) {
  if (!bytes) return fault_answer(bytes.error());
  HttpAnswer answer = fresh_answer(std::move(*bytes), type);
  answer.headers.emplace_back("Content-Disposition", "attachment; filename=\"" + file + "\"");
  return answer;
}

HttpAnswer text_answer(const std::string& name, studio::ShelfResult<std::string> text) {
  return file_answer(name + ".x3d", "model/x3d+xml; charset=utf-8", std::move(text));
}

HttpAnswer archive_answer(const std::string& name, studio::ShelfResult<std::string> archive) {
  return file_answer(name + ".zip", "application/zip", std::move(archive));
}

Author author_of(const Session& session) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return {session.user, std::chrono::duration_cast<std::chrono::seconds>(now).count()};
}

/// What the browser may ask for of the scene is known from then on.
void answer_scene(GatewaySite& site, const std::string& name, const Site::Done& done) {
  const auto heard = std::make_shared<SceneMeshes>();
  site.studio().give(
      [name, heard](Shelf& shelf) {
        const auto compiled = shelf.compile(name);
        if (!compiled) return fault_answer(compiled.error());
        auto text = draft_scene(*compiled, *heard);
        return text ? fresh_answer(*text) : refusal(text.error());
      },
      [&site, heard, done](HttpAnswer answer) {
        if (answer.status == 200) site.backstage().content.hear(heard->status, heard->objects);
        done(std::move(answer));
      });
}

/// What a POST to a draft asks for, ready to be done on the desk's thread. Errors: what is wrong with the request; not_found for an
/// address that the studio does not have.
Expected<StudioDesk::Work> work_of(const DraftPath& path, const std::string& body, const Author& author) {
  const std::string& name = path.name;
  if (path.verb == "versions") {
    auto title = studio::parse_stated(body, "title", studio::Versions::kLongestTitle);
    if (!title) return tl::unexpected(title.error());
    return [=](Shelf& shelf) { return answer_of(shelf.add_version(name, *title, author)); };
  }
  if (path.verb == "commands") {
    auto list = studio::parse_command_list(body);
    if (!list) return tl::unexpected(list.error());
    return [=, list = std::move(*list)](Shelf& shelf) { return answer_of(shelf.change(name, list, author)); };
  }
  if (path.verb == "take") {
    auto file = studio::parse_stated(body, "path", kLongestPath);
    if (!file) return tl::unexpected(file.error());
    return [=](Shelf& shelf) { return answer_of(shelf.take_file(name, *file)); };
  }
  if (const std::string file = deleted_file(path.verb); !file.empty())
    return [=](Shelf& shelf) { return answer_of(shelf.remove_file(name, file)); };
  const auto version = restored_version(path.verb);
  const bool known = version || path.verb == "undo" || path.verb == "redo" || path.verb == "publish" ||
                     path.verb == "discard" || path.verb == "merge";
  if (!known) return fail(ErrorCode::not_found, "there is nothing at this address", "", "see COMMANDS.md");
  const auto revision = studio::parse_revision(body);
  if (!revision) return tl::unexpected(revision.error());
  if (version) return [=, r = *revision](Shelf& shelf) { return answer_of(shelf.restore(name, *version, r, author)); };
  if (path.verb == "undo") return [=, r = *revision](Shelf& shelf) { return answer_of(shelf.undo(name, r, author)); };
  if (path.verb == "redo") return [=, r = *revision](Shelf& shelf) { return answer_of(shelf.redo(name, r, author)); };
  if (path.verb == "discard") return [=, r = *revision](Shelf& shelf) { return answer_of(shelf.discard(name, r)); };
  if (path.verb == "merge") {
    auto from = studio::parse_stated(body, "from", 2 * kLongestDraftName);
    if (!from) return tl::unexpected(from.error());
    return [=, r = *revision](Shelf& shelf) { return answer_of(shelf.merge(name, r, *from, author)); };
  }
  return [=, r = *revision](Shelf& shelf) { return answer_of(shelf.publish(name, r, author)); };
}

StudioDesk::Work upload_work(const DraftPath& path, const HttpRequest& request, const Author& author) {
  const auto body = std::make_shared<const std::string>(request.body);
  if (path.verb == kImport)
    return [name = path.name, body, author](Shelf& shelf) {
      return answer_of(shelf.unpack(name, std::as_bytes(std::span(*body)), author));
    };
  if (path.verb == kPicture)
    return [name = path.name, body](Shelf& shelf) {
      return answer_of(shelf.set_picture(name, std::as_bytes(std::span(*body))));
    };
  const bool replace = request.query_value("replace") == "1";
  return [name = path.name, file = path.verb.substr(kFiles.size()), body, replace](Shelf& shelf) {
    return answer_of(shelf.add_file(name, file, std::as_bytes(std::span(*body)), replace));
  };
}

Expected<StudioDesk::Work> about_work(const std::string& body) {
  auto about = studio::parse_about(body);
  if (!about) return tl::unexpected(about.error());
  return [about = std::move(*about)](Shelf& shelf) { return answer_of(shelf.describe(about)); };
}

StudioDesk::Work catalogue_work(const HttpRequest& request) {
  studio::CatalogueQuery query{request.query_value("text"), request.query_value("kind"), request.query_value("tag"),
                               request.query_value("licence"), request.query_value("language")};
  return [query = std::move(query)](Shelf& shelf) { return answer_of(shelf.catalogue(query)); };
}

Expected<StudioDesk::Work> begin_work(const std::string& body, const Author& author) {
  auto name = studio::parse_stated(body, "name", kLongestDraftName);
  if (!name) return tl::unexpected(name.error());
  auto from = studio::parse_stated(body, "from", 2 * kLongestDraftName);
  if (!from) return tl::unexpected(from.error());
  return [=](Shelf& shelf) { return answer_of(shelf.begin(*name, *from, author)); };
}

/// A draft that is gone is not tried any more.
Site::Done stopping_preview(GatewaySite& site, const std::string& draft, const Site::Done& done) {
  return [&site, draft, done](HttpAnswer answer) {
    if (answer.status == 200) site.previews().stop(draft);
    done(std::move(answer));
  };
}

/// What a POST asks for, at whatever address of the studio.
Expected<StudioDesk::Work> posted_work(const std::optional<DraftPath>& path, const HttpRequest& request,
                                       const Author& author) {
  if (request.path == kAbout) return about_work(request.body);
  if (!path) return begin_work(request.body, author);
  if (longest_studio_upload(request.path) > 0) return upload_work(*path, request, author);
  return work_of(*path, request.body, author);
}

}  // namespace

HttpAnswer fault_answer(const studio::ShelfFault& fault) {
  return fresh_answer(studio::fault_json(fault), "application/json", status_of(fault));
}

std::size_t longest_studio_upload(const std::string& path) {
  const auto draft = draft_path(path);
  if (!draft) return 0;
  if (draft->verb == kImport) return studio::kMostArchiveBytes;
  if (draft->verb == kPicture) return Shelf::kMostPictureBytes;
  return draft->verb.starts_with(kFiles) && deleted_file(draft->verb).empty() ? studio::DraftFiles::kMostBytes : 0;
}

bool answer_studio_get(GatewaySite& site, const HttpRequest& request, const Site::Done& done) {
  if (request.path == "/api/studio/schema") {
    site.studio().give([](Shelf&) { return fresh_answer(studio::schema_json()); }, done);
    return true;
  }
  if (request.path == "/api/studio/exhibits") {
    site.studio().give([](Shelf& shelf) { return answer_of(shelf.list()); }, done);
    return true;
  }
  if (request.path == kCatalogue) return site.studio().give(catalogue_work(request), done), true;
  const auto path = draft_path(request.path);
  if (!path) return false;
  const std::string& name = path->name;
  if (answer_preview_get(site, name, path->verb, done)) return true;
  if (path->verb == "scene") return answer_scene(site, name, done), true;
  StudioDesk::Work work;
  if (path->verb.empty()) work = [name](Shelf& shelf) { return answer_of(shelf.view(name)); };
  if (path->verb == "text") work = [name](Shelf& shelf) { return text_answer(name, shelf.text(name)); };
  if (path->verb == "export") work = [name](Shelf& shelf) { return archive_answer(name, shelf.pack(name)); };
  if (path->verb == "versions") work = [name](Shelf& shelf) { return answer_of(shelf.versions(name)); };
  if (path->verb == "files") work = [name](Shelf& shelf) { return answer_of(shelf.files(name)); };
  if (path->verb == kPicture)
    work = [name](Shelf& shelf) {
      const auto webp = shelf.picture(name);
      return webp ? fresh_answer(*webp, "image/webp") : fault_answer(webp.error());
    };
  if (path->verb.starts_with(kFiles))
    work = [name, file = path->verb.substr(kFiles.size())](Shelf& shelf) {
      return answer_of(shelf.nodes_of_file(name, file));
    };
  if (!work) return false;
  return site.studio().give(std::move(work), done), true;
}

bool answer_studio_post(GatewaySite& site, const Session& session, const HttpRequest& request, const Site::Done& done) {
  if (!request.path.starts_with(kStudio)) return false;
  if (session.role == Role::visitor)
    return done(refusal(403, "this is for the role author or operator", "sign in as somebody who has it")), true;
  const auto path = draft_path(request.path);
  const bool tells = request.path == "/api/studio/drafts" || request.path == kAbout;
  if (!path && !tells) return false;
  const bool tries = path && is_preview_verb(path->verb);
  Expected<StudioDesk::Work> work;
  if (!tries) work = posted_work(path, request, author_of(session));
  if (!work) return done(fault_answer({work.error()})), true;
  // A draft's history tells of each edit what it was.
  const bool passing = path && (is_passing(path->verb) || path->verb == kPicture);
  if (!passing && !site.note(session, request, request.path, tells ? utf8_beginning(request.body, 200) : ""))
    return done(refusal(500, "the audit log cannot be written, so nothing was done", "see the gateway's log")), true;
  if (tries) return answer_preview_post(site, path->name, path->verb, request.body, done), true;
  if (path && path->verb == "discard")
    return site.studio().give(std::move(*work), stopping_preview(site, path->name, done)), true;
  site.studio().give(std::move(*work), done);
  return true;
}

}  // namespace mechane::gateway
