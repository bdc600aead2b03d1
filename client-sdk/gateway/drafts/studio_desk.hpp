// StudioDesk: the drafts of authors, for the API of the studio.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>

#include "client-sdk/gateway/http/http_types.hpp"
#include "server/base/worker.hpp"

namespace mechane::studio {
class Shelf;
}

namespace mechane::gateway {

/// Owns a thread, which alone reads and writes drafts. Its function is for the loop's thread, and does not wait.
class StudioDesk {
 public:
  using Post = std::function<void(std::function<void()>)>;
  using Work = std::function<HttpAnswer(studio::Shelf&)>;

  /// `scenarios`: the server's exhibits; empty: every request is refused. `state`: the gateway's own folder. `post` runs a job on the loop's
  /// thread.
  StudioDesk(const std::filesystem::path& scenarios, const std::filesystem::path& state, Post post);
  ~StudioDesk();
  StudioDesk(const StudioDesk&) = delete;
  StudioDesk& operator=(const StudioDesk&) = delete;

  /// Does work in its turn; `done` gets its answer on the loop's thread.
  void give(Work work, Site::Done done);

 private:
  std::unique_ptr<studio::Shelf> shelf_;  ///< for the work on the thread; null: no folder of exhibits was given
  const Post post_;
  std::size_t waiting_ = 0;          ///< for the loop's thread
  Worker thread_{"gateway-studio"};  ///< last: it ends before what it uses
};

}  // namespace mechane::gateway
