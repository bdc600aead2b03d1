#include "client-sdk/gateway/drafts/studio_scene.hpp"

#include <algorithm>
#include <span>

#include "client-sdk/gateway/browsers/browser_text.hpp"
#include "client-sdk/studio/view/shapes_glb.hpp"
#include "server/base/whole_file.hpp"
#include "server/content/content_hash.hpp"
#include "server/content/mesh_import.hpp"
#include "server/state/affordances.hpp"

namespace mechane::gateway {
namespace {

constexpr const char* kShapesFile = "shapes.glb";

client::Texts texts_of(const state::Texts& texts) {
  return {texts.begin(), texts.end()};
}

client::Affordance affordance_of(const state::Affordance& from, const state::WorldDescription& world) {
  using Kind = client::Affordance::Kind;
  client::Affordance out;
  out.kind = static_cast<Kind>(from.kind);  // the numbers of both are those on the wire
  if (from.agent) out.agent = world.agents[from.agent.index()].name;
  out.object = static_cast<std::uint32_t>(from.object.index());
  if (from.base) out.base = static_cast<std::uint32_t>(from.base.index());
  out.X_AJ = from.X_AJ;
  out.X_BJ = from.X_BJ;
  return out;
}

client::Effect effect_of(const state::EffectDescription& from) {
  client::Effect out;
  out.name = from.name;
  out.kind = from.kind;
  if (from.body) out.object = static_cast<std::uint32_t>(from.body.index());
  out.node = from.node;
  out.p_BE = from.p_BE;
  out.direction_B = from.direction_B;
  out.quantity = from.quantity ? static_cast<std::uint32_t>(from.quantity.index()) : 0;
  out.full = from.full;
  out.size_m = from.size_m;
  out.speed_m_per_s = from.speed_m_per_s;
  return out;
}

/// Writes the shapes of the draft's own file beside it, and gives their objects the new file.
Expected<void> give_shapes(const studio::CompiledDraft& draft, std::vector<client::SceneObject>& objects,
                           SceneMeshes& meshes) {
  const auto own = [&](const client::SceneObject& object) { return object.mesh_uri == draft.own_url; };
  if (std::ranges::none_of(objects, own)) return {};
  const auto scene = content::import_mesh(draft.file);
  if (!scene) return tl::unexpected(scene.error());
  const std::string glb = studio::glb_of(*scene);
  const std::filesystem::path file = std::filesystem::absolute(draft.file).parent_path() / kShapesFile;
  if (auto written = write_whole(file, std::as_bytes(std::span(glb)), WholeFile::durable); !written) return written;
  const std::string hash = content::content_hash(std::as_bytes(std::span(glb)));
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!own(objects[i])) continue;
    objects[i].mesh_uri = kShapesFile;
    objects[i].mesh_hash = meshes.objects[i].mesh_hash = hash;
    meshes.objects[i].mesh_uri = file.string();
  }
  return {};
}

/// A file that the draft has is looked for there, not in the exhibit's folder.
void give_own_files(const studio::CompiledDraft& draft, SceneMeshes& meshes) {
  const std::filesystem::path folder = std::filesystem::absolute(draft.file).parent_path();
  for (client::SceneObject& object : meshes.objects) {
    const std::filesystem::path own = studio::own_file(folder, object.mesh_uri);
    if (!own.empty()) object.mesh_uri = own.string();
  }
}

}  // namespace

std::vector<client::SceneObject> scene_objects_of(const state::WorldDescription& world) {
  std::vector<client::SceneObject> out;
  for (const state::BodyDescription& body : world.bodies) {
    client::SceneObject object;
    object.index = static_cast<std::uint32_t>(out.size());
    object.name = body.name;
    object.mesh_uri = body.mesh.uri;
    object.mesh_hash = body.mesh.content_hash;
    object.mesh_node = body.mesh.node;
    object.X_WB = body.X_WB;
    object.movable = !body.fixed;
    object.title = texts_of(body.title);
    out.push_back(std::move(object));
  }
  return out;
}

client::WorldPresentation presentation_of(const state::WorldDescription& world) {
  client::WorldPresentation out;
  out.world = world.id;
  out.languages = world.languages;
  for (const state::ActivityDescription& activity : world.activities) {
    client::Activity& one = out.activities.emplace_back();
    one.name = activity.name;
    one.title = texts_of(activity.title);
    one.goal = texts_of(activity.goal);
  }
  for (const state::Viewpoint& view : world.viewpoints) {
    client::View& one = out.views.emplace_back();
    one.name = view.name;
    one.X_WV = view.X_WV;
    one.field_of_view_rad = view.field_of_view_rad;
  }
  for (const state::EffectDescription& effect : world.effects)
    if (!effect.felt) out.effects.push_back(effect_of(effect));
  for (const state::Affordance& affordance : state::affordances_of(world))
    out.affordances.push_back(affordance_of(affordance, world));
  return out;
}

Expected<std::string> draft_scene(const studio::CompiledDraft& draft, SceneMeshes& meshes) {
  std::vector<client::SceneObject> objects = scene_objects_of(draft.world);
  // No id: a draft must not take the place of an exhibit that kiosks show.
  meshes.status.scenario_folder = std::filesystem::absolute(draft.exhibit_folder).string();
  meshes.objects = objects;
  give_own_files(draft, meshes);
  if (auto given = give_shapes(draft, objects, meshes); !given) return tl::unexpected(given.error());
  return "{\"scene\":" + scene_text(objects) + ",\"presentation\":" + presentation_text(presentation_of(draft.world)) +
         "}";
}

}  // namespace mechane::gateway
