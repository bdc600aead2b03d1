// How long a display takes for a picture of a scenario, pass by pass, offscreen: at the start of the visit, nobody
// there. Wall time, and the processor's (all threads: a software renderer's cost, however busy the machine is). From a
// frame's receipt to its picture. Memory.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <sys/resource.h>

#include "client-sdk/client/frame_history.hpp"
#include "client-sdk/client/parse.hpp"
#include "client-sdk/display/display_loop.hpp"
#include "client-sdk/display/spare_memory.hpp"
#include "client-sdk/draw/renderer.hpp"
#include "client-sdk/picture/image_file.hpp"
#include "client-sdk/recording/recorded_client.hpp"
#include "client-sdk/scene/scene_builder.hpp"
#include "server/base/clock.hpp"
#include "server/content/mesh_import.hpp"
#include "server/scenario/compiler.hpp"
#include "server/scenario/file_finder.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::benchmark {
namespace {

struct Config {
  std::string scenario;
  std::string out;
  std::string stereo = "mono";
  draw::Quality quality = draw::Quality::high;
  std::string visit;  ///< a recording of the place; empty: the start of the visit
  int frames = 15;
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
};

std::vector<client::SceneObject> objects_of(const state::WorldDescription& world) {
  std::vector<client::SceneObject> out;
  for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
    const state::BodyDescription& body = world.bodies[i];
    client::SceneObject object;
    object.index = i;
    object.name = body.name;
    object.mesh_uri = body.mesh.uri;
    object.mesh_node = body.mesh.node;
    object.X_WB = body.X_WB;
    object.movable = !body.fixed;
    out.push_back(object);
  }
  return out;
}

/// Where a visitor's display stands, and what flows there before anything moves.
std::shared_ptr<const client::WorldPresentation> presentation_of(const state::WorldDescription& world) {
  auto out = std::make_shared<client::WorldPresentation>();
  for (const state::Viewpoint& view : world.viewpoints)
    out->views.push_back({view.name, view.X_WV, view.field_of_view_rad});
  for (const state::EffectDescription& effect : world.effects) {
    if (effect.kind != "flow") continue;
    client::Effect& river = out->effects.emplace_back();
    river.kind = effect.kind;
    river.node = effect.node;
    river.direction_B = effect.direction_B;
    river.speed_m_per_s = effect.speed_m_per_s;
  }
  return out;
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// What a server sends of a world in which everything movable moves a little.
class FrameSource {
 public:
  explicit FrameSource(const state::WorldDescription& world) : world_(world), visible_(world.bodies.size(), 1) {}

  /// The next frame, a sixtieth of a second on. It looks into this object.
  const proto::SceneFrame& next() {
    ++frame_.seq;
    frame_.protocol = proto::kProtocol;
    frame_.sent_ns = frame_.seq * 16'666'667;
    bodies_.clear();
    for (std::uint32_t i = 0; i < world_.bodies.size(); ++i) {
      if (world_.bodies[i].fixed) continue;
      Pose X_WB = world_.bodies[i].X_WB;
      X_WB.p.y() += 0.001 * static_cast<double>(frame_.seq % 2);
      bodies_.emplace_back().object = i;
      proto::set_pose(bodies_.back().X_WB, X_WB);
    }
    proto::look_into(frame_.bodies, bodies_);
    proto::look_into(frame_.visible, visible_);
    return frame_;
  }

 private:
  const state::WorldDescription& world_;
  std::vector<std::uint8_t> visible_;
  std::vector<proto::WireBodyPose> bodies_;
  proto::SceneFrame frame_{};
};

/// From a frame as it comes from the network to the finished picture of it. A display shows each frame
/// kInterpolationDelay after its receipt: this is counted, the wait for the screen is not.
Expected<void> measure_latency(const Config& config, picture::Stereo stereo, const state::WorldDescription& world,
                               scene::SceneBuilder& builder, const picture::SceneAssets& assets, Report& report) {
  auto renderer = draw::Renderer::create({});
  if (!renderer) return tl::unexpected(renderer.error());
  (*renderer)->upload(assets);
  FrameSource source(world);
  client::FrameHistory history;
  client::Frame frame;
  Samples latency(static_cast<std::size_t>(config.frames));
  for (int i = -2; i < config.frames; ++i) {
    const proto::SceneFrame& wire = source.next();
    const TimePoint received = std::chrono::steady_clock::now();
    if (!client::parse(wire, frame))
      return fail(ErrorCode::invalid_value, "a frame was refused", config.scenario, "correct this benchmark");
    frame.received = received;
    history.add(frame, wire.sent_ns);
    (void)history.at(received, frame);
    const picture::RenderScene scene = builder.build(&frame, nullptr, client::LinkState::joined);
    if (auto ok = (*renderer)->draw(scene, stereo, {config.width, config.height}); !ok) return ok;
    draw::Renderer::finish();
    if (i >= 0) latency.add(std::chrono::steady_clock::now() - received + display::kInterpolationDelay);
  }
  report.metric("latency_ms.median", latency.quantile_us(0.5) / 1000);
  report.metric("latency_ms.p99", latency.quantile_us(0.99) / 1000);
  return {};
}

/// The most that this process has held so far; on a graphics card textures and meshes are there, and not counted.
double peak_mib() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<double>(usage.ru_maxrss) / 1024 : 0;
}

/// The telling moment of a recorded visit, the third of its four: hands, and all bodies that have moved since the
/// first, move a little from picture to picture.
class BusyMoment {
 public:
  static Expected<BusyMoment> open(const std::string& file) {
    auto recording = recording::FrameRecording::open_file(file);
    if (!recording) return tl::unexpected(recording.error());
    return BusyMoment(recording::RecordedClient(std::move(*recording), {}));
  }

  void prepare(scene::SceneBuilder& builder) {
    builder.set_presentation(client_.presentation());
    builder.set_manifest(client_.objects());
  }

  picture::RenderScene scene(scene::SceneBuilder& builder, int picture) const {
    client::Frame frame = frame_;
    const double up_m = 0.002 * std::sin(0.5 * picture);
    for (client::BodyPose& body : frame.bodies) {
      if (moved_.contains(body.object)) body.X_WB.p.y() += up_m;
    }
    for (client::HandPose& hand : frame.hands) {
      for (Pose& X_WS : hand.X_WS)
        X_WS.p.y() += up_m;
    }
    picture::RenderScene out = builder.build(&frame, &status_, client_.state());
    out.time_s += picture / 30.0;
    return out;
  }

 private:
  explicit BusyMoment(recording::RecordedClient client) : client_(std::move(client)) {
    client::Frame first;
    client_.advance(TimePoint{});
    (void)client_.newest_frame(first);
    client_.advance(TimePoint{} + std::chrono::seconds(2));
    (void)client_.newest_frame(frame_);
    status_ = client_.world_status().value_or(client::WorldStatus{});
    for (const client::BodyPose& body : frame_.bodies) {
      const auto before = std::ranges::find(first.bodies, body.object, &client::BodyPose::object);
      if (before == first.bodies.end() || (before->X_WB.p - body.X_WB.p).norm() > 1e-4 ||
          before->X_WB.R.angularDistance(body.X_WB.R) > 1e-3)
        moved_.insert(body.object);
    }
  }

  recording::RecordedClient client_;
  client::Frame frame_;
  client::WorldStatus status_;
  std::set<std::uint32_t> moved_;
};

Expected<void> measure_passes(const Config& config, picture::Stereo stereo, const state::WorldDescription& world,
                              scene::SceneBuilder& builder, const picture::SceneAssets& assets, Report& report) {
  draw::RendererSettings settings;
  settings.profile = true;
  settings.quality = config.quality;
  auto renderer = draw::Renderer::create(settings);
  if (!renderer) return tl::unexpected(renderer.error());
  (*renderer)->upload(assets);
  std::map<std::string, std::vector<double>> wall_ms;
  std::map<std::string, std::vector<double>> cpu_ms;
  FrameSource source(world);
  client::Frame moved;
  for (int frame = -2; frame < config.frames; ++frame) {
    if (!client::parse(source.next(), moved))
      return fail(ErrorCode::invalid_value, "a frame was refused", config.scenario, "correct this benchmark");
    picture::RenderScene scene = builder.build(&moved, nullptr, client::LinkState::joined);
    scene.time_s += frame / 60.0;
    if (auto ok = (*renderer)->draw(scene, stereo, {config.width, config.height}); !ok) return ok;
    std::map<std::string, draw::PassTime> sums;
    for (const draw::PassTime& time : (*renderer)->pass_times()) {
      for (const std::string& name : {std::string(time.pass), std::string("frame")}) {
        sums[name].wall_ms += time.wall_ms;
        sums[name].cpu_ms += time.cpu_ms;
      }
    }
    if (frame < 0) continue;  // shaders are compiled while the first are drawn
    for (const auto& [name, time] : sums) {
      wall_ms[name].push_back(time.wall_ms);
      cpu_ms[name].push_back(time.cpu_ms);
    }
  }
  for (const auto& [name, values] : wall_ms) {
    report.metric(name + ".wall_ms.median", quantile(values, 0.5));
    report.metric(name + ".cpu_ms.median", quantile(cpu_ms[name], 0.5));
    report.metric(name + ".cpu_ms.p99", quantile(cpu_ms[name], 0.99));
  }
  return config.out.empty() ? Expected<void>() : picture::write_png((*renderer)->read_picture(), config.out);
}

double cpu_ms() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Whole pictures of a moment in which things move, without a wait between passes.
Expected<void> measure_moment(const Config& config, picture::Stereo stereo, scene::AssetLibrary& library,
                              Report& report) {
  auto moment = BusyMoment::open(config.visit);
  if (!moment) return tl::unexpected(moment.error());
  scene::SceneBuilder builder(library, "en");
  moment->prepare(builder);
  draw::RendererSettings settings;
  settings.quality = config.quality;
  auto renderer = draw::Renderer::create(settings);
  if (!renderer) return tl::unexpected(renderer.error());
  (*renderer)->upload(library.assets());
  Samples wall(static_cast<std::size_t>(config.frames));
  std::vector<double> all_ms;
  std::vector<double> other_ms;
  // Shaders are compiled, and what stands still is found and kept.
  constexpr int kFirst = -3 - static_cast<int>(draw::LowRenderer::kStill + draw::LowRenderer::kSlices);
  for (int picture = kFirst; picture < config.frames; ++picture) {
    const TimePoint began = std::chrono::steady_clock::now();
    const double began_ms = cpu_ms();
    const picture::RenderScene scene = moment->scene(builder, picture - kFirst);
    (void)(*renderer)->lay_out(scene, stereo, {config.width, config.height});
    const double built_ms = cpu_ms();
    if (auto ok = (*renderer)->draw(scene, stereo, {config.width, config.height}); !ok) return ok;
    draw::Renderer::finish();
    if (picture < 0) continue;
    wall.add(std::chrono::steady_clock::now() - began);
    all_ms.push_back(cpu_ms() - began_ms);
    other_ms.push_back(built_ms - began_ms);
  }
  report.metric("picture.wall_ms.median", wall.quantile_us(0.5) / 1000);
  report.metric("picture.cpu_ms.median", quantile(all_ms, 0.5));
  // A close-up is drawn in every second picture: the mean counts.
  report.metric("picture.cpu_ms.mean", std::accumulate(all_ms.begin(), all_ms.end(), 0.0) / config.frames);
  report.metric("picture.cpu_ms.p99", quantile(all_ms, 0.99));
  report.metric("other.cpu_ms.p99", quantile(other_ms, 0.99));
  return config.out.empty() ? Expected<void>() : picture::write_png((*renderer)->read_picture(), config.out);
}

Expected<void> measure(const Config& config, const state::WorldDescription& world, scene::AssetLibrary& library,
                       Report& report) {
  const auto stereo =
      std::ranges::find(picture::stereo_names(), config.stereo, &std::pair<std::string_view, picture::Stereo>::first);
  if (stereo == picture::stereo_names().end())
    return fail(ErrorCode::unknown_name, "no such mode", config.stereo, "see mechane display --help");
  if (!config.visit.empty()) {
    auto context = draw::make_offscreen_context({config.width, config.height});
    if (!context) return tl::unexpected(context.error());
    report.note((*context)->renderer_name());
    return measure_moment(config, stereo->second, library, report);
  }
  scene::SceneBuilder builder(library, "en");
  builder.set_manifest(objects_of(world));
  builder.set_presentation(presentation_of(world));
  const picture::RenderScene scene = builder.build(nullptr, nullptr, client::LinkState::joined);
  std::size_t triangles = 0;
  for (const picture::Instance& instance : scene.instances)
    triangles += library.assets().meshes[instance.mesh].indices.size() / 3;
  report.metric("instances", static_cast<double>(scene.instances.size()));
  report.metric("triangles", static_cast<double>(triangles));
  auto context = draw::make_offscreen_context({config.width, config.height});
  if (!context) return tl::unexpected(context.error());
  report.note((*context)->renderer_name());
  if (auto ok = measure_latency(config, stereo->second, world, builder, library.assets(), report); !ok) return ok;
  report.metric("peak_mib", peak_mib());
  return measure_passes(config, stereo->second, world, builder, library.assets(), report);
}

int main_of(const Config& config) {
  scenario::FileFinder finder;
  x3d::Problems problems(config.scenario);
  const auto world = scenario::read_scenario(config.scenario, finder, problems);
  if (!world) {
    std::cerr << "bench_display: " << world.error().to_string() << "\n";
    return 1;
  }
  const std::filesystem::path folder = std::filesystem::path(config.scenario).parent_path();
  scene::AssetLibrary library([&](const std::string& uri) { return content::import_mesh(folder / uri); });
  Report report;
  if (auto ok = measure(config, *world, library, report); !ok) {
    std::cerr << "bench_display: " << ok.error().to_string() << "\n";
    return 1;
  }
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  mechane::benchmark::Config config;
  CLI::App app{"Draws a scenario as a display does, and times each pass"};
  app.add_option("scenario", config.scenario, "X3D file")->required()->check(CLI::ExistingFile);
  app.add_option("--frames", config.frames, "pictures that count, by pass and of the latency")
      ->check(CLI::Range(1, 10'000));
  app.add_option("--width", config.width, "pixels")->check(CLI::Range(16, 8192));
  app.add_option("--height", config.height, "pixels")->check(CLI::Range(16, 8192));
  app.add_option("--stereo", config.stereo, "as mechane display has it");
  app.add_option_function<std::string>(
         "--quality", [&config](const std::string& name) { config.quality = *mechane::draw::quality_of(name); },
         "high, medium, low or cached")
      ->check(CLI::IsMember({"high", "medium", "low", "cached"}));
  app.add_option("--visit", config.visit, "recording of the place: whole pictures of its third moment, things moving")
      ->check(CLI::ExistingFile);
  app.add_option("--out", config.out, "writes the last picture, PNG");
  CLI11_PARSE(app, argc, argv);
  mechane::display::keep_large_blocks_apart();  // as a display does: it decides what a picture on the processor costs
  return mechane::benchmark::main_of(config);
}
