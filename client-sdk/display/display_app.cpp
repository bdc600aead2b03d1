#include "client-sdk/display/display_app.hpp"

#include <charconv>
#include <filesystem>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "client-sdk/display/display_loop.hpp"
#include "client-sdk/display/kiosk_setup.hpp"
#include "server/base/assert.hpp"
#include "server/base/worker.hpp"
#include "server/log/log.hpp"

namespace mechane::display {
namespace {

Expected<void> make_folder(const std::string& folder) {
  if (folder.empty()) return {};
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    return fail(ErrorCode::io_failure, "the folder for pictures cannot be made: " + error.message(), folder,
                "choose another with --out");
  return {};
}

/// The options, reduced to what the window can do. `window` is null offscreen.
DisplayOptions possible_options(const DisplayOptions& options, const Window* window) {
  DisplayOptions possible = options;
  if (options.stereo == picture::Stereo::quad_buffer && (window == nullptr || !window->has_quad_buffer())) {
    log::warning(
        "this display cannot show a picture for each eye (quad-buffered stereo), so it shows a mono picture: try "
        "--stereo "
        "sbs, top-bottom, rows or anaglyph");
    possible.stereo = picture::Stereo::mono;
  }
  return possible;
}

}  // namespace

std::string DisplaySummary::to_json() const {
  const nlohmann::ordered_json json{{"pictures", pictures},
                                    {"frames", frames},
                                    {"frame_ms", {{"median", frame_ms_median}, {"p99", frame_ms_p99}}},
                                    {"missing_assets", missing_assets},
                                    {"differing_assets", differing_assets},
                                    {"steps_missed", steps_missed},
                                    {"done", done},
                                    {"renderer", renderer},
                                    {"sound", sound}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Expected<picture::PixelSize> parse_size(const std::string& text) {
  picture::PixelSize size;
  const char* end = text.data() + text.size();
  const auto [cross, error] = std::from_chars(text.data(), end, size.width);
  const bool first = error == std::errc() && cross != end && *cross == 'x';
  const auto last = first ? std::from_chars(cross + 1, end, size.height) : std::from_chars_result{cross, error};
  const auto fits = [](std::uint32_t side) { return side >= 16 && side <= 8192; };
  if (!first || last.ec != std::errc() || last.ptr != end || !fits(size.width) || !fits(size.height)) {
    return fail(ErrorCode::invalid_value, "'" + text + "' is not the size of a picture", "--size",
                "write width x height in pixels, 16 to 8192, as in 1280x720");
  }
  return size;
}

Expected<DisplaySummary> run_display(const DisplayOptions& options, DisplaySignals& signals) {
  MECHANE_ASSERT(options.fps > 0);
  if (auto ok = make_folder(options.out); !ok) return tl::unexpected(ok.error());
  if (assets::is_web_address(options.assets)) {
    if (auto address = assets::AssetAddress::parse(options.assets); !address) return tl::unexpected(address.error());
  }
  std::optional<content::Catalogue> catalogue;
  if (!options.catalogue.empty()) {
    auto opened = content::Catalogue::open(options.catalogue, content::Catalogue::Access::read);
    if (!opened) return tl::unexpected(opened.error());
    catalogue.emplace(std::move(*opened));
  }
  // Pictures and films wait for their models; a window does not.
  std::optional<Worker> worker;
  if (!options.offscreen) worker.emplace("imports");
  Worker* beside = worker ? &*worker : nullptr;
  // Before the context is made, so that the driver's threads inherit it. Without permission nothing changes.
  if (options.offscreen) setpriority(PRIO_PROCESS, 0, 10);
  std::unique_ptr<draw::GlContext> context;
  Window* window = nullptr;
  if (options.offscreen) {
    auto opened = draw::make_offscreen_context(options.size);
    if (!opened) return tl::unexpected(opened.error());
    context = std::move(*opened);
  } else {
    auto opened =
        make_window(options.size, "Mechane", {options.stereo == picture::Stereo::quad_buffer, options.full_screen});
    if (!opened) return tl::unexpected(opened.error());
    window = opened->get();
    context = std::move(*opened);
  }
  DisplayOptions possible = possible_options(options, window);
  // With auto, the cheapest first: the loop measures what draws.
  possible.renderer.quality =
      draw::quality_of(options.quality).value_or(options.offscreen ? draw::Quality::high : draw::Quality::cached);
  auto renderer = draw::Renderer::create(possible.renderer);
  if (!renderer) return tl::unexpected(renderer.error());
  client::ClientConfig config;
  config.kiosk = options.kiosk;
  config.program = "mechane-display";
  config.display = options.name;
  config.domain = options.domain;
  auto source = open_source(options.source, config);
  if (!source) return tl::unexpected(source.error());
  auto attract = open_attract(options, catalogue ? &*catalogue : nullptr, beside);
  if (!attract) return tl::unexpected(attract.error());
  if (source->recorded != nullptr) possible.ask = visit::AskWhen::none;  // nobody can answer
  return DisplayLoop(possible, signals, *context, window, std::move(*renderer), *source,
                     catalogue ? &*catalogue : nullptr, beside, std::move(*attract))
      .run();
}

}  // namespace mechane::display
