// What a server tells of its exhibits, as a sample of ExhibitStatus.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "server/state/description.hpp"
#include <mechane/proto/topics.hpp>

namespace mechane::transport {

/// Fields as in idl/mechane.idl.
struct OpenableExhibit {
  std::string id;
  std::string content_hash;
  state::Texts title;
  std::uint32_t worlds = 0;
  std::uint32_t former_worlds = 0;
  friend bool operator==(const OpenableExhibit&, const OpenableExhibit&) = default;
};

struct ExhibitAnswer {
  std::uint64_t id = 0;
  std::string refusal;  ///< empty: done
  std::string place;
  std::string remedy;
  friend bool operator==(const ExhibitAnswer&, const ExhibitAnswer&) = default;
};

struct ExhibitStatusData {
  bool changeable = false;  ///< this and the next two are filled in by the transport
  std::array<std::uint8_t, 16> key_mark{};
  std::uint64_t counter = 0;
  std::string preparing{};
  std::vector<OpenableExhibit> exhibits{};
  std::vector<std::string> loadable{};
  std::vector<ExhibitAnswer> answers{};
  friend bool operator==(const ExhibitStatusData&, const ExhibitStatusData&) = default;
};

/// A sample with the storage that its sequences point at. Its address must not change. Names of server and times are the writer's to fill
/// in.
class WireExhibits {
 public:
  /// `data` outlives it.
  explicit WireExhibits(const ExhibitStatusData& data);
  WireExhibits(const WireExhibits&) = delete;
  WireExhibits& operator=(const WireExhibits&) = delete;

  [[nodiscard]] proto::ExhibitStatus& wire() { return wire_; }

 private:
  proto::ExhibitStatus wire_{};
  std::deque<std::vector<proto::WireText>> titles_;  // a deque: its elements keep their addresses
  std::vector<proto::WireExhibit> exhibits_;
  std::vector<char*> loadable_;
  std::vector<proto::WireExhibitAnswer> answers_;
};

}  // namespace mechane::transport
