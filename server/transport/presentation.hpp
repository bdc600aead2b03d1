// The WorldPresentation of a world: what displays show and what never changes.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "server/state/description.hpp"
#include <mechane/proto/topics.hpp>

namespace mechane::transport {

/// A WorldPresentation with the storage that its sequences point at. Its address must not change.
class Presentation {
 public:
  /// `description` outlives it.
  Presentation(const std::string& world, const state::WorldDescription& description);
  Presentation(const Presentation&) = delete;
  Presentation& operator=(const Presentation&) = delete;

  [[nodiscard]] const proto::WorldPresentation& wire() const { return wire_; }

 private:
  void add_activities(const state::WorldDescription& description);
  void add_views(const state::WorldDescription& description);
  void add_effects(const state::WorldDescription& description);
  void add_affordances(const state::WorldDescription& description);
  [[nodiscard]] proto::WireQuestion question_of(const state::QuestionDescription& question);
  /// Lets a sequence of texts point at a copy kept here.
  template <class Sequence>
  void set_texts(Sequence& sequence, const state::Texts& texts);

  proto::WorldPresentation wire_{};
  std::vector<char*> languages_;
  std::deque<std::vector<proto::WireText>> texts_;  // a deque: its elements keep their addresses
  std::deque<std::vector<proto::WireAnswer>> answers_;
  std::deque<std::vector<proto::WireQuestion>> questions_;
  std::vector<proto::WireActivity> activities_;
  std::vector<proto::WireView> views_;
  std::vector<proto::WireEffect> effects_;
  std::vector<proto::WireAffordance> affordances_;
};

}  // namespace mechane::transport
