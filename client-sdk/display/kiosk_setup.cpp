#include "client-sdk/display/kiosk_setup.hpp"

#include "server/base/assert.hpp"
#include "server/log/log.hpp"

namespace mechane::display {
namespace {

/// None if assets come from a folder.
std::unique_ptr<assets::AssetStore> open_asset_store(const DisplayOptions& display) {
  if (!assets::is_web_address(display.assets)) return nullptr;
  assets::AssetStoreOptions options;
  options.cache_folder = display.asset_cache;
  options.cache_bytes = std::uint64_t{display.asset_cache_mib} << 20U;
  auto address = assets::AssetAddress::parse(display.assets);
  MECHANE_ASSERT(address.has_value());  // checked by run_display()
  auto store = assets::AssetStore::open(std::move(*address), options);
  if (store) return std::move(*store);
  log::error(store.error());
  return nullptr;
}

}  // namespace

client::DisplaySettings settings_at_start(const DisplayOptions& options) {
  client::DisplaySettings settings;
  settings.volume = options.sound.volume;
  settings.muted = !options.sound.on;
  settings.language = options.language;
  settings.large_text = options.overlay.text_scale > 1;
  settings.high_contrast = options.overlay.high_contrast;
  settings.ask = visit::ask_name(options.ask);
  settings.home_after_s = options.home_after_s;
  settings.attract = !options.attract.empty();
  settings.attract_after_s = options.attract_after_s;
  settings.quality = options.quality;
  settings.hand = options.hand;
  return settings;
}

DisplayIdentity identity_of(const DisplayOptions& options, const draw::GlContext& context) {
  return {options.kiosk, options.name,         context.renderer_name(), options.offscreen,
          options.fps,   !options.out.empty(), !options.attract.empty()};
}

scene::AssetSource open_assets(const DisplayOptions& options, const content::Catalogue* catalogue, Worker* worker) {
  return {options.assets, open_asset_store(options), catalogue, worker};
}

Expected<std::unique_ptr<AttractLoop>> open_attract(const DisplayOptions& options, const content::Catalogue* catalogue,
                                                    Worker* worker) {
  if (options.attract.empty()) return nullptr;
  return AttractLoop::open(options.attract, open_assets(options, catalogue, worker));
}

}  // namespace mechane::display
