#include "server/content/importer/gltf_counts.hpp"

#include <cstdint>
#include <fstream>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "server/content/model_references.hpp"

namespace mechane::content {
namespace {

using Json = nlohmann::json;

/// The reader copies vertices that several primitives share once for each, and joins them afterwards: while it reads, a good file may have
/// more of them than ImportLimits::vertices. This many times as many fit into ImportLimits::memory_bytes.
constexpr std::uint64_t kVerticesWhileReading = 4;

/// Reads the JSON once, and keeps only what check_gltf_counts needs. Places in it are paths without the indices of arrays:
/// "/nodes/children".
class Counter final : public Json::json_sax_t {
 public:
  explicit Counter(const ImportLimits& limits) : limits_(limits) {}

  /// What is over the limits; nothing where all is within them.
  [[nodiscard]] std::optional<Error> fault() const {
    if (nodes_.size() > limits_.nodes || placed_nodes() > limits_.nodes) {
      return Error{ErrorCode::too_large,
                   fmt::format("more than {} nodes, counted wherever they are placed", limits_.nodes),
                   {},
                   "leave out copies, or join small objects in the model"};
    }
    if (primitives_.size() > limits_.meshes) {
      return Error{ErrorCode::too_large,
                   fmt::format("{} meshes; the limit is {}", primitives_.size(), limits_.meshes),
                   {},
                   "join small objects in the model"};
    }
    const std::uint64_t most = kVerticesWhileReading * limits_.vertices;
    const std::uint64_t vertices = std::accumulate(
        primitives_.begin(), primitives_.end(), std::uint64_t{0}, [&](std::uint64_t sum, std::uint64_t accessor) {
          return std::min(most + 1, sum + std::min(most + 1, count_of(accessor)));
        });
    if (vertices > most) {
      return Error{ErrorCode::too_large,
                   fmt::format("more than {} vertices, counted for each mesh that uses them", most),
                   {},
                   "simplify the model, or give each mesh only its own vertices"};
    }
    return std::nullopt;
  }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }  // a negative one
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }
  bool key(string_t& name) override {
    path_.resize(lengths_.back());
    path_ += '/' + name;
    return true;
  }
  bool start_object(std::size_t) override {
    if (path_ == "/nodes") nodes_.emplace_back();
    if (path_ == "/scenes") scenes_.emplace_back();
    if (path_ == "/accessors") counts_.push_back(0);
    lengths_.push_back(path_.size());
    return nodes_.size() <= limits_.nodes && primitives_.size() <= limits_.meshes;
  }
  bool end_object() override {
    path_.resize(lengths_.back());
    lengths_.pop_back();
    return true;
  }
  bool number_unsigned(number_unsigned_t value) override {
    if (path_ == "/scene") scene_ = value;
    if (path_ == "/scenes/nodes" && !scenes_.empty()) scenes_.back().push_back(value);
    if (path_ == "/nodes/children" && !nodes_.empty()) nodes_.back().push_back(value);
    if (path_ == "/meshes/primitives/attributes/POSITION") primitives_.push_back(value);
    if (path_ == "/accessors/count" && !counts_.empty()) counts_.back() = value;
    return true;
  }

 private:
  [[nodiscard]] std::uint64_t count_of(std::uint64_t accessor) const {
    return accessor < counts_.size() ? counts_[accessor] : 0;
  }
  /// Of the scene that is shown. Stops beyond the limit: nodes may be their own children.
  [[nodiscard]] std::uint64_t placed_nodes() const {
    if (scene_ >= scenes_.size()) return 0;
    std::vector<std::uint64_t> waiting = scenes_[scene_];
    std::uint64_t placed = 0;
    while (!waiting.empty() && placed <= limits_.nodes && waiting.size() <= limits_.nodes) {
      const std::uint64_t node = waiting.back();
      waiting.pop_back();
      ++placed;
      if (node < nodes_.size()) waiting.insert(waiting.end(), nodes_[node].begin(), nodes_[node].end());
    }
    return placed + waiting.size();
  }

  const ImportLimits& limits_;
  std::string path_;
  std::vector<std::size_t> lengths_;  ///< of the path at each object that is open
  std::uint64_t scene_ = 0;
  std::vector<std::vector<std::uint64_t>> scenes_;  ///< their nodes
  std::vector<std::vector<std::uint64_t>> nodes_;   ///< their children
  std::vector<std::uint64_t> primitives_;           ///< the accessor of each one's vertices
  std::vector<std::uint64_t> counts_;               ///< of accessors
};

}  // namespace

Expected<void> check_gltf_counts(const std::filesystem::path& file, const ImportLimits& limits) {
  std::ifstream in(file, std::ios::binary);
  static_cast<void>(seek_glb_json(in));
  Counter counter(limits);
  Json::sax_parse(in, &counter, Json::input_format_t::json, false);  // not strict: bytes follow in a .glb
  if (auto fault = counter.fault()) return tl::unexpected<Error>(std::move(*fault));
  return {};
}

}  // namespace mechane::content
